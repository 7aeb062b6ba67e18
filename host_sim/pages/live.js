'use strict';
// The live page: plots of the received records, state and faults, parameters, the part with the tool and its force.
const $ = id => document.getElementById(id);
const make = (tag, properties, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children);
  return node;
};

// Received records, in one ring for all plots.
const kKept = 1 << 16, kColumns = 720;
class Store {
  constructor(recordBytes) {
    this.words = recordBytes / 4;
    this.u32 = new Uint32Array(kKept * this.words);
    this.f32 = new Float32Array(this.u32.buffer);
    this.i32 = new Int32Array(this.u32.buffer);
    this.count = 0;  // total
  }
  get first() { return Math.max(0, this.count - kKept); }
  baseOf(i) { return (i & (kKept - 1)) * this.words; }
  push(view) {
    const base = this.baseOf(this.count++);
    for (let i = 0; i < this.words; ++i) this.u32[base + i] = view.getUint32(4 + 4 * i, true);
    return base;
  }
  /** Value `k` of a field, in its unit, from the record at `base`. */
  value(field, base, k) {
    const at = base + field.offset / 4 + k;
    return (field.kind === 2 ? this.f32 : field.kind === 1 ? this.i32 : this.u32)[at] * field.number[0] + field.number[1];
  }
  vector(field, base) { return [0, 1, 2].map(k => this.value(field, base, k)); }
}

/** One plot: least and greatest of every column of the picture, brought up to date record by record. */
class Plot {
  constructor(name) {
    this.select = make('select', { ariaLabel: 'what is plotted' });
    this.head = make('div', { className: 'head' }, this.select);
    this.canvas = make('canvas', { tabIndex: 0 });
    for (const f of page.session.fields)
      if (f.unit !== 'bits' && f.name !== 'number') this.select.add(new Option(titleOf(f), f.name, false, f.name === name));
    this.select.onchange = () => this.show(this.select.value);
    $('plots').append(make('section', { className: 'card plot' }, this.head, this.canvas));
    this.hover = null;  // share of the width
    this.listen();
    this.show(name);
  }
  show(name) {
    this.field = page.session.field(name);
    const n = this.field.count;
    this.lines = n === 3 && this.field.kind === 2 ? 4 : n;  // a vector also gets a line for its length
    this.scale = this.field.unit === 'm' ? 1000 : 1;
    this.unit = this.field.unit === 'm' ? 'mm' : this.field.unit === '1' ? '' : this.field.unit;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', titleOf(this.field));
    this.head.querySelectorAll('.value').forEach(old => old.remove());
    const names = n === 1 ? [''] : ['x', 'y', 'z', 'length'].slice(0, this.lines);
    this.values = names.map((name, k) => {
      const mark = make('i', {}), text = make('span', {});
      mark.style.background = `var(--c${n === 1 ? 0 : k})`;
      const value = make('span', { className: 'value' }, mark, text);
      value.dataset.line = name;
      this.head.append(value);
      return { name, text };
    });
    this.now = new Float32Array(this.lines);
    this.rebuild();
  }
  rebuild() {
    this.low = this.values.map(() => new Float32Array(kColumns).fill(NaN));
    this.high = this.values.map(() => new Float32Array(kColumns).fill(NaN));
    this.stamp = new Float64Array(kColumns).fill(-1);
    const { store } = page, last = page.lastColumn();
    for (let i = store.first; i < store.count; ++i) {
      const base = store.baseOf(i), column = page.columnOf(store.u32[base]);
      if (column > last - kColumns && column <= last) this.add(column, base);
    }
  }
  add(column, base) {
    const slot = ((column % kColumns) + kColumns) % kColumns;
    if (this.stamp[slot] !== column) {
      this.stamp[slot] = column;
      for (let k = 0; k < this.lines; ++k) this.low[k][slot] = Infinity, this.high[k][slot] = -Infinity;
    }
    let square = 0;
    for (let k = 0; k < this.lines; ++k) {
      const v = k < this.field.count ? page.store.value(this.field, base, k) * this.scale : Math.sqrt(square);
      square += v * v;
      this.now[k] = v;
      if (v < this.low[k][slot]) this.low[k][slot] = v;
      if (v > this.high[k][slot]) this.high[k][slot] = v;
    }
  }
  /** Slots of the columns that hold records, in order of time. */
  filled(last) {
    const list = [];
    for (let c = last - kColumns + 1; c <= last; ++c) {
      const slot = ((c % kColumns) + kColumns) % kColumns;
      if (this.stamp[slot] === c) list.push([c, slot]);
    }
    return list;
  }
  range(filled) {
    let low = Infinity, high = -Infinity;
    for (const [, slot] of filled)
      for (let k = 0; k < this.lines; ++k) low = Math.min(low, this.low[k][slot]), high = Math.max(high, this.high[k][slot]);
    if (!(high >= low)) low = 0, high = 1;
    if (low > 0 && low < 0.5 * high) low = 0;
    if (high - low < 1e-9 * Math.max(1, Math.abs(high))) low -= 0.5, high += 0.5;
    const spread = high - low;
    return [low - 0.04 * spread, high + 0.04 * spread];
  }
  draw(last) {
    const dense = window.devicePixelRatio || 1, { canvas } = this, style = page.style;
    const width = Math.round(canvas.clientWidth * dense), height = Math.round(canvas.clientHeight * dense);
    if (!width || !height) return;
    if (canvas.width !== width || canvas.height !== height) canvas.width = width, canvas.height = height;
    const g = canvas.getContext('2d'), filled = this.filled(last), [low, high] = this.range(filled);
    const left = 54 * dense, right = width - 4 * dense, top = 6 * dense, bottom = height - 20 * dense;
    const y = v => bottom - (v - low) / (high - low) * (bottom - top), first = last - kColumns + 1;
    const x = c => left + (c - first) / (kColumns - 1) * (right - left);
    g.clearRect(0, 0, width, height);
    g.font = `${11 * dense}px system-ui, sans-serif`;
    g.textBaseline = 'middle';
    g.lineWidth = dense;
    const rule = (x0, y0, x1, y1, colour) => { g.strokeStyle = colour; g.beginPath(); g.moveTo(x0, y0); g.lineTo(x1, y1); g.stroke(); };
    const step = nice((high - low) / 3);
    g.textAlign = 'right';
    g.fillStyle = style.soft;
    for (let v = Math.ceil(low / step) * step; v <= high; v += step) {
      const isZero = Math.abs(v) < step / 2, at = Math.round(y(v)) + 0.5;
      rule(left, at, right, at, isZero ? style.edge : style.grid);
      g.fillText(isZero ? '0' : tick(v, step), left - 6 * dense, y(v));
    }
    // Seconds before the last record.
    const seconds = page.seconds, behind = (page.newestColumn() - last) * page.perColumn * page.period_s, each = nice(seconds / 5);
    for (let t = Math.ceil(behind / each - 1e-9) * each; t < behind + seconds + each / 2; t += each) {
      const at = Math.round(right - (right - left) * (t - behind) / seconds) + 0.5;
      if (at < left) break;
      rule(at, bottom, at, bottom + 4 * dense, style.grid);
      g.textAlign = at > right - 16 * dense ? 'right' : 'center';
      g.fillText(t < each / 2 ? (page.session.live && !page.paused ? 'now' : 'last') : `\u2212${tick(t, each)} s`, at, bottom + 12 * dense);
    }
    g.lineWidth = 1.4 * dense;
    g.lineJoin = 'round';
    const most = page.mostBetween();
    for (let k = 0; k < this.lines; ++k) {
      g.strokeStyle = style.line[this.field.count === 1 ? 0 : k];
      g.beginPath();
      let before = -Infinity;
      for (const [c, slot] of filled) {
        if (c - before > most) g.moveTo(x(c), y(this.low[k][slot]));
        else g.lineTo(x(c), y(this.low[k][slot]));
        if (this.high[k][slot] !== this.low[k][slot]) g.lineTo(x(c), y(this.high[k][slot]));
        before = c;
      }
      g.stroke();
    }
    const at = this.hover === null ? null : filled.reduce((near, c) => near && Math.abs(x(near[0]) - this.hover * dense) < Math.abs(x(c[0]) - this.hover * dense) ? near : c, null);
    if (at) rule(Math.round(x(at[0])) + 0.5, top, Math.round(x(at[0])) + 0.5, bottom, style.soft);
    if (page.frame % 6 !== 0 && !at) return;
    this.values.forEach((value, k) => {
      const shown = at ? this.high[k][at[1]] : this.now[k];
      const said = `${value.name}${value.name ? ' ' : ''}${figure(shown)} ${this.unit}`;
      if (value.text.textContent !== said) value.text.textContent = said;
    });
  }
  // The wheel zooms when the plot has the focus; a drag goes back in time.
  listen() {
    const { canvas } = this;
    let from = null;
    canvas.addEventListener('pointermove', e => {
      const box = canvas.getBoundingClientRect();
      this.hover = e.clientX - box.left;
      if (from === null) return;
      page.goBack((e.clientX - from) / (box.width - 58) * kColumns);
      from = e.clientX;
    });
    canvas.addEventListener('pointerleave', () => { this.hover = null; });
    canvas.addEventListener('pointerdown', e => {
      from = e.clientX;
      canvas.focus({ preventScroll: true });
      try { canvas.setPointerCapture(e.pointerId); } catch { /* made by a script */ }
    });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { from = null; });
    canvas.addEventListener('wheel', e => {
      if (document.activeElement !== canvas) return;
      e.preventDefault();
      page.setSeconds(page.seconds * Math.exp(e.deltaY * 0.002));
    }, { passive: false });
    canvas.addEventListener('dblclick', () => { page.setSeconds(Number($('window').value)); page.pause(false); });
  }
}
function nice(rough) {
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * (rough < 1.5 * power ? 1 : rough < 3.5 * power ? 2 : rough < 7.5 * power ? 5 : 10);
}
const tick = (v, step) => Math.abs(v) >= 1e5 ? v.toExponential(1) : v.toFixed(Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9))));
function figure(v) {
  if (!Number.isFinite(v)) return String(v);
  const a = Math.abs(v);
  return a >= 1e6 ? v.toExponential(2) : Number.isInteger(v) ? String(v) : a >= 100 ? v.toFixed(1) : a >= 1 ? v.toFixed(2) : v.toFixed(3);
}
const plain = v => String(Number(v.toPrecision(7)));  // a float32 without its last digits
const unitOf = row => row.unit === '1' ? '' : row.unit;
/** output.guide_deviation_m -> guide deviation */
function titleOf(field) {
  const [side, rest] = field.name.includes('.') ? field.name.split('.') : ['', field.name];
  const bare = rest.replace(/_(m|mps|N|us|s|Hz|radps|rad)$/, '').replace(/_/g, ' ');
  return (side === 'input' ? 'input: ' : '') + bare + (field.unit === '1' ? '' : `, ${field.unit === 'm' ? 'mm' : field.unit}`);
}
function save(name, type, parts) {
  const link = make('a', { href: URL.createObjectURL(new Blob(parts, { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** A parameter's row: slider and number, or a button for each named value. */
class Parameter {
  constructor(session, row) {
    Object.assign(this, { session, row, held: row.number[3], wanted: null });
    const [low, high, initial] = row.number;
    const choices = [...row.text.matchAll(/(\d): (.+?)(?=, \d: |$)/g)].map(m => [Number(m[1]), m[2]]);
    const what = choices.length > 1 ? row.text.slice(0, row.text.indexOf(`${choices[0][0]}: `)).replace(/[:, ]+$/, '') : row.text;
    this.said = make('div', { className: 'said' });
    this.said.setAttribute('role', 'status');
    const label = make('label', { textContent: row.name, htmlFor: `parameter-${row.index}` });
    const about = [what, choices.length > 1 ? '' : `${plain(low)} to ${plain(high)}, initially ${plain(initial)}`, row.kind ? kWhen[row.kind] : ''];
    this.element = make('div', { className: 'parameter' }, label, make('div', { className: 'what', textContent: about.filter(Boolean).join(' \u00B7 ') }));
    this.element.dataset.parameter = row.name;
    this.element.append(choices.length > 1 ? this.buttons(choices) : this.sliderRow(low, high, initial), this.said);
    this.show(this.held);
  }
  buttons(choices) {
    const box = make('div', { className: 'choices' });
    for (const [value, text] of choices) {
      const button = make('button', { type: 'button', textContent: text, onclick: () => this.apply(value) });
      button.dataset.value = value;
      box.append(button);
    }
    this.show = value => { for (const b of box.children) b.setAttribute('aria-pressed', String(Number(b.dataset.value) === value)); };
    return box;
  }
  sliderRow(low, high, initial) {
    const { row } = this;
    const slider = make('input', { type: 'range', min: 0, max: 1000, step: 1, ariaLabel: row.name });
    const number = make('input', { type: 'number', step: 'any', min: plain(low), max: plain(high), id: `parameter-${row.index}` });
    // The initial value is at the slider's middle, so that ranges over many powers of ten are usable.
    const share = (initial - low) / (high - low), bend = share > 0 && share < 0.5 ? Math.min(12, Math.log(share) / Math.log(0.5)) : 1;
    this.show = value => {
      number.value = plain(value);
      slider.value = String(Math.round(1000 * Math.max(0, (value - low) / (high - low)) ** (1 / bend)));
    };
    slider.oninput = () => {
      const rounded = Number(Math.fround(low + (high - low) * (slider.value / 1000) ** bend).toPrecision(3));
      number.value = plain(Math.max(low, Math.min(high, rounded)));
    };
    slider.onchange = () => this.apply(Number(number.value));
    number.onchange = () => this.apply(number.value === '' ? NaN : Number(number.value));
    return make('div', { className: 'row' }, slider, number, make('span', { className: 'unit', textContent: unitOf(row) }));
  }
  say(kind, what) { this.said.className = 'said ' + kind; this.said.textContent = what; }
  /** Result: whether the controller took it. */
  async apply(value) {
    const { row } = this, [low, high] = row.number;
    if (!(value >= low) || !(value <= high)) {
      this.say('bad', `not sent: ${row.name} is ${plain(low)} to ${plain(high)} ${unitOf(row)}`);
      this.show(this.held);
      return false;
    }
    this.wanted = value;
    if (this.busy) return false;
    this.busy = true;
    let isTaken = false;
    while (this.wanted !== null) {
      const next = this.wanted;
      this.wanted = null;
      this.say('wait', 'sent\u2026');
      try {
        const result = await this.session.set(row.index, next);
        isTaken = result.taken;
        if (isTaken) this.say('good', `acknowledged: ${plain(this.held)} \u2192 ${plain(result.value)} ${unitOf(row)}`);
        else this.say('bad', `${plain(next)}: ${result.why}`);
        if (result.value !== undefined) this.held = result.value;
      } catch (error) { this.say('bad', `not acknowledged: ${error.message}`); }
      if (this.wanted === null) this.show(this.held);
    }
    this.busy = false;
    return isTaken;
  }
}
const kGroups = [['Contact', /^(contact|tool|mesh|surface|friction|texture)_/], ['Guide', /^(guide|curve)_/],
  ['Safety and time', /^(force|slew|ramp|late|model|tick|energy)/], ['Device', /^(velocity|max_speed|counts|origin|workspace|joint|device)/], ['Scene', /^scene_/], ['Other', /./]];
