// What an author can do on the page: parameters, camera, region, probe, comparison, exposure, files.
import { OrbitCamera } from '/camera.js';
import { Parameters } from '/params.js';

export class Controls {
  constructor(tools) {
    Object.assign(this, tools);
    this.state = null;
    this.pinned = null;
    this.busy = new Set();
    this.next = new Map();
    this.params = new Parameters(this);
    this.orbit = new OrbitCamera((camera) => this.wish('camera', camera));
    this.connect_buttons();
    this.connect_mouse();
    document.addEventListener('keydown', (event) => this.key(event));
  }

  // Wishes of one kind: one is under way, of those made meanwhile only the last one follows.
  async wish(kind, value) {
    if (this.busy.has(kind)) {
      this.next.set(kind, value);
      return;
    }
    this.busy.add(kind);
    try {
      await this.ask('/wish', { scene: this.scene(), [kind.split(' ')[0]]: value });
    } catch (problem) {
      this.say(problem.message);
    }
    this.busy.delete(kind);
    if (this.next.has(kind)) {
      const value_then = this.next.get(kind);
      this.next.delete(kind);
      this.wish(kind, value_then);
    }
  }

  say(text) {
    this.by_id('probe-out').textContent = text;
  }

  mode() {
    return document.querySelector('input[name=mode]:checked').value;
  }

  // ---- what the daemon says

  show(state) {
    this.state = state;
    this.expose();
    this.params.show(state);
    if (state.camera) this.orbit.take(state.camera, state.size);
    this.by_id('camera-copy').disabled = !state.camera;
    this.by_id('camera-reset').disabled = !state.moved;
    this.by_id('region-reset').disabled = !state.cropped;
    this.by_id('pause').setAttribute('aria-pressed', state.paused);
    this.by_id('pause').firstChild.textContent = state.paused ? 'go on ' : 'pause ';
    if (state.size && !this.painter.frame) {
      [this.painter.canvas.width, this.painter.canvas.height] = state.size;
    }
  }

  drawn() {
    if (this.pinned) this.wipe();
  }

  expose() {
    const slider = this.by_id('exposure');
    this.by_id('exposure-out').textContent = Number(slider.value).toFixed(1);
    if (!this.state?.curve_of) return;
    if (this.painter.set_tone(this.state.exposure + Number(slider.value), this.state.curve_of)) {
      this.painter.redraw();
    }
  }

  // ---- buttons and keys

  connect_buttons() {
    const on = (id, action) => this.by_id(id).addEventListener('click', action);
    this.by_id('exposure').addEventListener('input', () => this.expose());
    this.by_id('wipe').addEventListener('input', () => this.wipe());
    on('pause', () => this.wish('paused', !this.state?.paused));
    on('camera-reset', () => this.wish('camera', null));
    on('camera-copy', () => this.copy_camera());
    on('region-reset', () => this.wish('region', null));
    on('pin', () => this.pin());
    for (const kind of ['png', 'exr']) on(`save-${kind}`, () => this.save(kind));
  }

  async copy_camera() {
    const text = this.state.camera.block;
    try {
      await navigator.clipboard.writeText(text);
      this.say('the camera block is on the clipboard');
    } catch {
      this.say(text);
    }
    document.body.dataset.copied = text;
  }

  async save(kind) {
    try {
      const answer = await this.ask(`/picture.${kind}?scene=${this.scene()}`);
      const link = this.element('a', { download: `${this.state.name.replace(/.*\//, '').replace(/\.\w+$/, '')}.${kind}` });
      link.href = URL.createObjectURL(await answer.blob());
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
      document.body.dataset.saved = kind;
    } catch (problem) {
      this.say(problem.message);
    }
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const in_field = event.target.matches('input:not([type=radio]), textarea');
    if (in_field) return;
    const modes = { c: 'camera', r: 'region', p: 'probe' };
    if (modes[event.key]) {
      document.querySelector(`input[name=mode][value=${modes[event.key]}]`).checked = true;
    } else if (event.key === 'a') {
      this.pin();
    } else if (event.key === ' ' && !event.target.matches('button, summary, a')) {
      this.by_id('pause').click();
      event.preventDefault();
    } else if (event.target === this.painter.canvas && this.orbit.key(event)) {
      event.preventDefault();
    }
  }

  // ---- comparison with a pinned picture

  pin() {
    const pinned = this.by_id('pinned');
    const was_pinned = this.pinned !== null;
    this.pinned = was_pinned ? null : this.painter.frame;
    this.by_id('pin').firstChild.textContent = was_pinned ? 'pin ' : 'unpin ';
    for (const id of ['wipe-box', 'wipe-line', 'pinned']) this.by_id(id).hidden = was_pinned || !this.pinned;
    if (!this.pinned) return;
    pinned.width = this.painter.canvas.width;
    pinned.height = this.painter.canvas.height;
    pinned.getContext('2d').drawImage(this.painter.canvas, 0, 0);
    this.wipe();
  }

  wipe() {
    const part = this.by_id('wipe').value;
    this.by_id('pinned').style.clipPath = `inset(0 ${100 - part}% 0 0)`;
    this.by_id('wipe-line').style.left = `${part}%`;
  }

  // ---- the mouse on the picture

  place_of(event) {
    const canvas = this.painter.canvas;
    const box = canvas.getBoundingClientRect();
    const clamp = (value, most) => Math.min(Math.max(value, 0), most);
    return {
      x: clamp((event.clientX - box.left) / box.width, 1) * canvas.width,
      y: clamp((event.clientY - box.top) / box.height, 1) * canvas.height,
    };
  }

  connect_mouse() {
    const canvas = this.painter.canvas;
    let drag = null;
    canvas.addEventListener('pointerdown', (event) => {
      canvas.focus();
      canvas.setPointerCapture(event.pointerId);
      const mode = event.altKey ? 'probe' : this.mode();
      drag = { mode, start: this.place_of(event), last: this.place_of(event) };
      if (mode === 'probe') this.probe(drag.start);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!drag) return;
      const place = this.place_of(event);
      if (drag.mode === 'camera') {
        const pan = event.shiftKey || event.buttons === 4 || event.buttons === 2;
        this.orbit[pan ? 'pan' : 'turn'](place.x - drag.last.x, place.y - drag.last.y, canvas);
      } else if (drag.mode === 'region') {
        this.rubber(drag.start, place);
      }
      drag.last = place;
    });
    const finish = (event) => {
      if (drag?.mode === 'region' && event.type === 'pointerup') this.choose_region(drag.start, this.place_of(event));
      this.by_id('rubber').hidden = true;
      drag = null;
    };
    canvas.addEventListener('pointerup', finish);
    canvas.addEventListener('pointercancel', finish);
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.orbit.dolly(Math.exp(Math.min(Math.max(event.deltaY, -200), 200) * 0.0015));
    }, { passive: false });
    canvas.addEventListener('dblclick', (event) => this.probe(this.place_of(event)));
  }

  rubber(a, b) {
    const { width, height } = this.painter.canvas;
    const box = this.by_id('rubber');
    box.hidden = false;
    box.style.left = `${100 * Math.min(a.x, b.x) / width}%`;
    box.style.top = `${100 * Math.min(a.y, b.y) / height}%`;
    box.style.width = `${100 * Math.abs(a.x - b.x) / width}%`;
    box.style.height = `${100 * Math.abs(a.y - b.y) / height}%`;
  }

  choose_region(a, b) {
    const region = [Math.min(a.x, b.x), Math.min(a.y, b.y), Math.max(a.x, b.x), Math.max(a.y, b.y)]
      .map((value) => Math.round(value));
    if (region[2] - region[0] < 4 || region[3] - region[1] < 4) return;
    this.wish('region', region);
  }

  async probe(place) {
    const { width, height } = this.painter.canvas;
    const x = Math.min(Math.floor(place.x), width - 1);
    const y = Math.min(Math.floor(place.y), height - 1);
    try {
      const answer = await (await this.ask('/probe', { scene: this.scene(), x, y })).json();
      const short = (list) => list.map((v) => Number(v).toPrecision(4)).join(', ');
      const parts = [`(${x}, ${y})`];
      if (answer.value) parts.push(`[${short(answer.value)}] of ${answer.samples} samples`);
      if (answer.places?.length) {
        const what = [answer.name, answer.material && `of ${answer.material}`].filter(Boolean).join(' ');
        parts.push(`${what || 'shape'} at ${answer.places.map((p) => p.place).join(' ← ')}`);
        parts.push(answer.places[0].line.trim());
      } else {
        parts.push(answer.distance === undefined ? 'nothing is hit' : 'a light');
      }
      if (answer.distance !== undefined) parts.push(`distance ${answer.distance.toPrecision(4)} m`);
      this.say(parts.join(' · '));
      document.body.dataset.probed = JSON.stringify(answer);
    } catch (problem) {
      this.say(problem.message);
    }
  }
}
