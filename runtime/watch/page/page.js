// The preview page: one WebSocket brings states (JSON) and pictures (binary), POSTs carry wishes.
// Everything that comes from the daemon is put in as text, never as HTML: it holds names of files.
import { Painter, parse_frame } from '/draw.js';
import { Controls } from '/controls.js';

const by_id = (id) => document.getElementById(id);
const place = new URLSearchParams(location.hash.slice(1));
if (place.get('token')) {
  sessionStorage.setItem('token', place.get('token'));
  history.replaceState(null, '', location.pathname);
}
const token = sessionStorage.getItem('token') || '';
// The address of a daemon started anew, put into the same tab, differs behind the `#` alone.
window.addEventListener('hashchange', () => {
  const given = new URLSearchParams(location.hash.slice(1)).get('token');
  if (!given) return;
  sessionStorage.setItem('token', given);
  history.replaceState(null, '', location.pathname);
  location.reload();
});
const scene_number = /^\/scene\/(\d+)$/.exec(location.pathname)?.[1] ?? null;

export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === 'class') made.className = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

async function ask(path, body) {
  const answer = await fetch(path, {
    method: body === undefined ? 'GET' : 'POST',
    headers: { 'X-Scenec-Token': token, ...(body !== undefined && { 'Content-Type': 'application/json' }) },
    body: body === undefined ? undefined : JSON.stringify(body),
  });
  if (!answer.ok) throw new Error((await answer.text()).trim() || `status ${answer.status}`);
  return answer;
}

const painter = new Painter(by_id('picture'));
const controls = new Controls({ ask, painter, scene: () => Number(scene_number ?? 0), element, by_id });
const state_of = new Map();

// ---- what a state says

const text_of_ms = (ms) => (ms < 10_000 ? `${ms.toFixed(0)} ms` : `${(ms / 1000).toFixed(1)} s`);

function show_status(state) {
  const status = by_id('status');
  status.className = state.status;
  const times = state.times;
  const parts = [state.status];
  if (state.samples) parts.push(`${state.samples} samples a pixel`);
  const last = state.curve?.at(-1);
  if (last) parts.push(`error ${(100 * last[2]).toFixed(2)} %`);
  if (times.first_picture !== undefined) parts.push(`first picture ${text_of_ms(times.first_picture)}`);
  if (times.finished !== undefined) parts.push(`finished ${text_of_ms(times.finished)}`);
  status.textContent = parts.join(' · ');
  document.title = `${state.status === 'broken' ? '✗ ' : ''}${state.name} — scenec watch`;
}

function show_findings(state) {
  const list = by_id('findings');
  list.replaceChildren(...state.findings.map((finding) =>
    element('li', { class: finding.severity }, element('pre', {}, finding.text))));
  const errors = state.findings.filter((f) => f.severity === 'error');
  by_id('finding-count').textContent = state.findings.length ? `(${state.findings.length})` : '(none)';
  const overlay = by_id('overlay');
  overlay.hidden = state.status !== 'broken';
  overlay.replaceChildren(...(overlay.hidden ? [] : errors.slice(0, 5)).map((f) => element('pre', {}, f.text)));
  by_id('stale').hidden = !state.stale;
  if (!overlay.hidden) stamp_painted('told', errors.map((f) => f.message).join().replaceAll(' ', '_'));
}

function show_progress(state) {
  const cap = state.sample_cap;
  by_id('progress').textContent = state.samples === undefined ? 'no picture yet'
    : `${state.samples} of ${cap >= 1048576 ? 'as many samples as it takes' : `${cap} samples`}`
      + (state.paused ? ' · paused' : '');
  by_id('phases').textContent = state.phases.map((p) => `${p.name} ${p.ms.toFixed(1)} ms`).join(' · ');
  by_id('change').textContent = state.change;
  by_id('changes').replaceChildren(...state.changes.map(change_item));
  const names = { assets: 'meshes and pictures', mesh_trees: 'trees of meshes', item_trees: 'trees over items' };
  by_id('reuse').textContent = Object.entries(names)
    .filter(([key]) => state.reuse[key].kept + state.reuse[key].made > 0)
    .map(([key, name]) => `${name}: ${state.reuse[key].kept} kept, ${state.reuse[key].made} made`).join(' · ');
}

// "sphere ball: radius, material"
function change_item(change) {
  const what = [change.count > 1 && `${change.count} ×`, change.family === 'shape' ? change.kind
    : change.family === 'render' ? 'render' : `${change.family} (${change.kind})`].filter(Boolean).join(' ');
  const rest = change.what === 'changed' ? `: ${change.keys.join(', ')}` : ` ${change.what}`;
  return element('li', { class: change.what }, what, change.name ? ' ' : '',
    element('b', {}, change.name), rest);
}

const SVG = 'http://www.w3.org/2000/svg';
function svg(name, attributes, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

// Error against time, both logarithmic: a straight line of slope -1/2 is what sampling gives.
function show_curve(state) {
  const picture = by_id('curve');
  const points = (state.curve ?? []).filter((p) => p[0] > 0 && p[2] > 0);
  if (points.length < 2) {
    picture.replaceChildren(svg('text', { x: 12, y: 80 }, 'the error is known after some samples'));
    return;
  }
  const log = Math.log10;
  const x_low = Math.floor(log(points[0][0]));
  const x_high = Math.max(x_low + 1, Math.ceil(log(points.at(-1)[0])));
  const y_low = Math.floor(log(Math.min(...points.map((p) => p[2]))));
  const y_high = Math.max(y_low + 1, Math.ceil(log(Math.max(...points.map((p) => p[2])))));
  const x = (seconds) => 40 + 270 * (log(seconds) - x_low) / (x_high - x_low);
  const y = (error) => 8 + 118 * (y_high - Math.min(Math.max(log(error), y_low), y_high)) / (y_high - y_low);
  const parts = [];
  for (let d = x_low; d <= x_high; ++d) {
    parts.push(svg('line', { class: 'grid', x1: x(10 ** d), x2: x(10 ** d), y1: 8, y2: 126 }));
    parts.push(svg('text', { x: x(10 ** d) - 8, y: 140 }, `${+(10 ** d).toPrecision(1)} s`));
  }
  for (let d = y_low; d <= y_high; ++d) {
    parts.push(svg('line', { class: 'grid', x1: 40, x2: 310, y1: y(10 ** d), y2: y(10 ** d) }));
    parts.push(svg('text', { x: 2, y: y(10 ** d) + 3 }, `${+(100 * 10 ** d).toPrecision(1)} %`));
  }
  const pair = (p, value) => `${x(p[0]).toFixed(1)},${y(Math.max(value, 1e-12)).toFixed(1)}`;
  const band = [...points.map((p) => pair(p, p[4])), ...points.toReversed().map((p) => pair(p, p[3]))];
  parts.push(svg('polygon', { class: 'band', points: band.join(' ') }));
  parts.push(svg('polyline', { class: 'line', points: points.map((p) => pair(p, p[2])).join(' ') }));
  picture.replaceChildren(...parts);
}

function show_effects(state) {
  const effects = state.effects ?? [];
  by_id('effect-count').textContent = `(${effects.filter((e) => e.simulated).length} of ${effects.length})`;
  by_id('effects').replaceChildren(...effects.map((e) => {
    const kind = e.simulated ? 'on' : e.switched_off ? 'forced' : 'off';
    const where = e.witness.map((w) => `${w.file}:${w.line}`).join(', ');
    return element('li', { title: e.doc }, element('span', { class: kind, 'aria-label': kind }),
      element('div', {}, e.name, element('small', {}, e.reason + (where ? ` — ${where}` : '')
        + (kind === 'forced' ? ' — switched off by the author: the picture is biased' : ''))));
  }));
}

let listed = null;  // the scenes to choose from, where there is a choice

function show_list(list) {
  listed = list.index;
  show_notices(list.notices);
  by_id('siblings').hidden = false;
  if (scene_number !== null) {
    const choice = by_id('sibling');
    choice.replaceChildren(...listed.map((one) => element('option', { value: one.scene }, one.name)));
    choice.value = scene_number;
    return;
  }
  by_id('siblings').hidden = true;
  by_id('index').hidden = false;
  by_id('empty').hidden = listed.length > 0;
  by_id('name').textContent = listed.length === 1 ? '1 scene' : `${listed.length} scenes`;
  by_id('status').textContent = '';
  by_id('status').className = '';
  const old = new Map([...by_id('scenes').children].map((item) => [item.dataset.scene, item]));
  by_id('scenes').replaceChildren(...listed.map((one) => old.get(`${one.scene}`)
    ?? element('li', { 'data-scene': one.scene },
      element('a', { href: `/scene/${one.scene}` }, element('img', { alt: '' }), one.name,
        element('small', {}, '')))));
  for (const state of state_of.values()) show_index(state);
}

function show_index(state) {
  const item = by_id('scenes').querySelector(`li[data-scene="${state.scene}"]`);
  if (!item) return;
  item.querySelector('small').textContent = ` ${state.status}`;
  item.querySelector('small').className = state.status === 'broken' ? 'error' : '';
  const image = item.querySelector('img');
  if (state.generation !== undefined && image.dataset.shown !== `${state.generation} ${state.status}`) {
    image.dataset.shown = `${state.generation} ${state.status}`;
    ask(`/picture.png?scene=${state.scene}`).then((answer) => answer.blob()).then((blob) => {
      URL.revokeObjectURL(image.src);
      image.src = URL.createObjectURL(blob);
    }).catch(() => {});
  }
}

function show_notices(notices) {
  by_id('notices').hidden = notices.length === 0;
  by_id('notices').replaceChildren(...notices.map((text) => element('li', {}, text)));
}

function show(state) {
  state_of.set(state.scene, state);
  show_notices(state.notices);
  if (listed && scene_number === null) {
    show_index(state);
    return;
  }
  by_id('scene').hidden = false;
  by_id('name').textContent = state.name;
  show_status(state);
  show_findings(state);
  show_progress(state);
  show_curve(state);
  show_effects(state);
  controls.show(state);
}

// When something new is on the screen, for whoever measures: "NUMBER TIME" in the body's data, time
// in milliseconds since 1970. A frame of the browser begins, and what it paints is out behind it.
function stamp_painted(what, number) {
  if (document.body.dataset[what]?.startsWith(`${number} `)) return;
  document.body.dataset[what] = `${number} `;
  requestAnimationFrame(() => setTimeout(() => {
    document.body.dataset[what] = `${number} ${performance.timeOrigin + performance.now()}`;
  }));
}

// ---- the stream

function show_frame(buffer, acknowledge) {
  const frame = parse_frame(buffer);
  if (!frame) return acknowledge();
  // A hidden page shows nothing and asks for nothing; it gets the newest picture when it is seen.
  const paint = () => {
    painter.draw(frame);
    controls.drawn(frame);
    document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
    document.body.dataset.generation = frame.generation;
    document.body.dataset.step = frame.step;
    stamp_painted('painted', frame.generation);
    acknowledge();
  };
  if (document.visibilityState === 'visible') paint();
  else document.addEventListener('visibilitychange', paint, { once: true });
}

let tries = 0;
function connect() {
  const which = scene_number ?? 'all';
  const socket = new WebSocket(`ws://${location.host}/stream?scene=${which}`, ['scenec', `token.${token}`]);
  socket.binaryType = 'arraybuffer';
  let opened = false;
  socket.onopen = () => {
    opened = true;
    tries = 0;
    by_id('offline').hidden = true;
  };
  socket.onmessage = (event) => {
    if (typeof event.data !== 'string') {
      show_frame(event.data, () => socket.readyState === 1 && socket.send('shown'));
      return;
    }
    const said = JSON.parse(event.data);
    if (said.index) show_list(said);
    else show(said);
  };
  socket.onclose = async () => {
    by_id('offline').hidden = false;
    by_id('status').textContent = 'not connected';
    by_id('status').className = 'broken';
    if (!opened && tries > 0) {
      const known = await ask('/alive').then(() => true, (problem) => !/printed/.test(problem.message));
      by_id('gate').hidden = known;
    }
    tries += 1;
    setTimeout(connect, Math.min(250 * tries, 2000));
  };
}

by_id('sibling').addEventListener('change', (event) => location.assign(`/scene/${event.target.value}`));

if (token) {
  connect();
} else {
  by_id('gate').hidden = false;
  by_id('status').textContent = '';
}
