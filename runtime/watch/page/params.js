// Fields for the scene's params: sliders where there is a range, colour fields, check boxes. Values
// travel as source text, so that what is tried is what is written back.

const encode = (c) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);
const hex_of = (rgb) => `#${rgb.map((c) => Math.round(255 * Math.min(Math.max(encode(c), 0), 1))
  .toString(16).padStart(2, '0')).join('')}`;
const number_text = (value) => {
  const text = String(Number(value.toPrecision(6)));
  return text.includes('e') ? value.toFixed(9).replace(/\.?0+$/, '') : text;
};

export class Parameters {
  constructor(controls) {
    this.controls = controls;
    this.by_id = controls.by_id;
    this.element = controls.element;
    this.rows = new Map();
    this.undo_list = [];
    this.key = '';
    this.by_id('undo').addEventListener('click', () => this.undo());
    this.by_id('reset').addEventListener('click', () => {
      this.remember_all();
      this.controls.wish('params', null);
    });
    this.by_id('apply').addEventListener('click', () => this.apply());
    this.by_id('cancel').addEventListener('click', () => { this.by_id('diff').hidden = true; });
  }

  show(state) {
    this.state = state;
    const params = state.params;
    this.by_id('params-box').hidden = params.length === 0;
    const key = JSON.stringify(params.map((p) => [p.name, p.type, p.kind, p.low, p.high, p.unit, p.doc]));
    if (key !== this.key) {
      this.key = key;
      this.rows.clear();
      this.by_id('params').replaceChildren(...params.map((p) => this.make_row(p)));
    }
    for (const p of params) this.fill(this.rows.get(p.name), p);
    this.by_id('reset').disabled = !params.some((p) => p.wished !== null);
    this.by_id('undo').disabled = this.undo_list.length === 0;
  }

  make_row(p) {
    const { element } = this;
    const row = { name: p.name, fields: [] };
    const id = `param-${p.name}`;
    const label = element('label', { for: id }, p.unit ? `${p.name} (${p.unit})` : p.name);
    const box = element('div', { class: 'param', 'data-param': p.name }, label);
    if (p.kind === 'boolean') {
      row.fields = [element('input', { type: 'checkbox', id })];
      row.read = () => String(row.fields[0].checked);
      row.write = (q) => { row.fields[0].checked = q.value[0] !== 0; };
    } else if (p.kind === 'color') {
      row.fields = [element('input', { type: 'color', id })];
      row.read = () => row.fields[0].value;
      row.write = (q) => { row.fields[0].value = hex_of(q.value); };
    } else if (p.kind === 'number' || p.kind === 'integer') {
      this.make_number(row, p, id);
    } else {
      row.fields = [element('input', { type: 'text', id })];
      row.read = () => row.fields[0].value;
      row.write = (q) => { row.fields[0].value = q.wished ?? (q.kind === 'string' ? q.string : q.text); };
    }
    box.append(...row.fields);
    if (p.doc) box.append(element('small', {}, p.doc));
    row.save = element('button', { type: 'button', title: 'write the value into the file' }, 'write back');
    row.back = element('button', { type: 'button', title: 'as it is in the file' }, 'reset');
    row.save.addEventListener('click', () => this.show_diff(row));
    row.back.addEventListener('click', () => this.set(row, null));
    row.buttons = element('span', { class: 'row' }, row.save, row.back);
    box.append(row.buttons);
    row.box = box;
    this.rows.set(p.name, row);
    for (const field of row.fields) {
      field.addEventListener('input', (event) => {
        row.sync?.(event.target);
        if (event.target.type !== 'text') this.set(row, row.read());
      });
      field.addEventListener('change', () => this.set(row, row.read()));
    }
    return box;
  }

  make_number(row, p, id) {
    const { element } = this;
    const whole = p.kind === 'integer';
    const field = element('input', { type: 'number', id, step: whole ? 1 : 'any' });
    row.read = () => (whole ? String(Math.round(Number(field.value)))
      : number_text(Number(field.value)) + row.unit);
    row.unit = p.unit;
    row.fields = [field];
    let slider = null;
    if (p.low !== undefined && p.high !== undefined) {
      const low = p.low / p.unit_size;
      const high = p.high / p.unit_size;
      slider = element('input', {
        type: 'range', 'aria-label': p.name, min: low, max: high, step: whole ? 1 : (high - low) / 200,
      });
      row.fields.push(slider);
    }
    if (p.unit) field.title = p.unit;
    row.sync = (changed) => {
      if (changed === slider) field.value = number_text(Number(slider.value));
      else if (slider) slider.value = field.value;
    };
    row.write = (q) => {
      const text = number_text(q.value[0] / q.unit_size);
      field.value = text;
      if (slider) slider.value = text;
    };
  }

  fill(row, p) {
    row.wished = p.wished;
    row.box.classList.toggle('changed', p.wished !== null);
    row.buttons.hidden = p.wished === null;
    row.save.disabled = this.state.status === 'broken';
    // What somebody is typing or dragging stays.
    const is_in_use = row.fields.includes(document.activeElement) && performance.now() - (row.set_at ?? -1e9) < 1500;
    if (!is_in_use) row.write(p);
  }

  set(row, value) {
    if (value === row.wished) return;
    const last = this.undo_list.at(-1);
    // A drag is one step back.
    if (!(last?.name === row.name && performance.now() - last.at < 700)) {
      this.undo_list.push({ name: row.name, value: row.wished ?? null, at: performance.now() });
    } else {
      last.at = performance.now();
    }
    row.set_at = value === null ? -1e9 : performance.now();
    row.wished = value;
    this.by_id('undo').disabled = false;
    this.controls.wish(`param ${row.name}`, { name: row.name, value });
  }

  remember_all() {
    for (const row of this.rows.values()) {
      if (row.wished != null) this.undo_list.push({ name: row.name, value: row.wished, at: 0 });
    }
  }

  undo() {
    const last = this.undo_list.pop();
    const row = last && this.rows.get(last.name);
    if (row) {
      row.wished = last.value;
      row.set_at = -1e9;
      this.controls.wish(`param ${row.name}`, { name: row.name, value: last.value });
    }
    this.by_id('undo').disabled = this.undo_list.length === 0;
  }

  async show_diff(row) {
    try {
      const request = { scene: this.controls.scene(), name: row.name, value: row.wished };
      const answer = await (await this.controls.ask('/source', request)).json();
      this.proposal = { ...request, hash: answer.hash, row };
      this.by_id('diff-text').textContent = answer.diff;
      this.by_id('diff').hidden = false;
    } catch (problem) {
      this.controls.say(problem.message);
    }
  }

  async apply() {
    const { row, ...request } = this.proposal;
    this.by_id('diff').hidden = true;
    try {
      await this.controls.ask('/source', { ...request, apply: true });
      this.controls.say(`${row.name} is written`);
      this.controls.wish(`param ${row.name}`, { name: row.name, value: null });
      this.undo_list = this.undo_list.filter((step) => step.name !== row.name);
    } catch (problem) {
      this.controls.say(problem.message);
    }
  }
}
