'use strict';
// Charts over one common time: each is an SVG of the page's width, drawn anew for every window of time.
const kMargin = { left: 52, right: 12, top: 16, bottom: 22 };

function svg(name, attributes, parent, text) {
  const node = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  if (parent) parent.append(node);
  return node;
}
/** About `count` round numbers from `low` to `high`. */
function marks(low, high, count) {
  const raw = (high - low) / count || 1, ten = 10 ** Math.floor(Math.log10(raw));
  const step = ten * (raw / ten > 5 ? 10 : raw / ten > 2 ? 5 : raw / ten > 1 ? 2 : 1), list = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) list.push(i * step);
  const digits = Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)));
  return list.map(value => [value, value.toFixed(digits)]);
}
function save(name, type, text) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** The window of time that all charts show, and the cursor in it. */
class TimeWindow {
  constructor(seconds, least_s, changed) {
    Object.assign(this, { seconds, least_s, changed, from: 0, to: seconds, cursor: 0 });
  }
  get span() { return this.to - this.from; }
  get isZoomed() { return this.span < this.seconds * 0.9999; }
  show(from, span) {
    span = Math.max(Math.min(this.least_s, this.seconds), Math.min(this.seconds, span));
    this.from = Math.max(0, Math.min(this.seconds - span, from));
    this.to = this.from + span;
    this.changed(true);
  }
  zoom(factor, at = this.cursor >= this.from && this.cursor <= this.to ? this.cursor : (this.from + this.to) / 2) {
    const span = Math.max(Math.min(this.least_s, this.seconds), Math.min(this.seconds, this.span * factor));
    this.show(at - (at - this.from) * span / this.span, span);
  }
  pan(seconds) { this.show(this.from + seconds, this.span); }
  all() { this.show(0, this.seconds); }
  set(cursor) {
    this.cursor = Math.max(0, Math.min(this.seconds, cursor));
    if (this.cursor < this.from || this.cursor > this.to) return this.show(this.cursor - this.span / 2, this.span);
    this.changed(false);
  }
}

class Chart {
  /** `section`: its card, with a header. `about`: chart and curves as page_data.cpp writes them. */
  constructor(section, about, bin_s, axis, time, name, isFirst) {
    Object.assign(this, { section, about, bin_s, axis, time, name, isFirst, hidden: new Set() });
    for (const curve of about.curves) {
      curve.low = new Float32Array(View3d.bytes(curve.low));
      const high = View3d.bytes(curve.high);
      curve.high = high.byteLength ? new Float32Array(high) : curve.low;
    }
    this.node = svg('svg', { class: 'chart', tabindex: 0, role: 'img', 'aria-label': `${about.title} over time` });
    const header = section.querySelector('header'), keys = document.createElement('div');
    keys.className = 'keys';
    this.values = about.curves.map((curve, k) => {
      const key = document.createElement('button');
      key.type = 'button';
      key.setAttribute('aria-pressed', 'true');
      key.title = 'hide or show this line';
      key.innerHTML = '<i></i><span></span><span class="value"></span>';
      key.children[0].style.background = curve.colour;
      key.children[1].textContent = curve.label;
      key.onclick = () => {
        const isShown = !this.hidden.delete(k) && !this.hidden.add(k);
        key.setAttribute('aria-pressed', String(!this.hidden.has(k)));
        this.draw(isShown);
      };
      keys.append(key);
      return key.lastChild;
    });
    if (isFirst)
      for (const [colour, text] of [['second', 'in contact'], ['good', 'on the guide']])
        if (axis[text === 'in contact' ? 'contact' : 'guide'].length)
          keys.insertAdjacentHTML('beforeend', `<span><i style="background:var(--${colour})"></i>${text}</span>`);
    const saves = document.createElement('span');
    saves.className = 'saves';
    for (const [text, title, act] of [['SVG', 'save this chart as a picture', () => this.saveSvg()], ['CSV', 'save the data of this window', () => this.saveCsv()]]) {
      const button = Object.assign(document.createElement('button'), { type: 'button', textContent: text, title });
      button.onclick = act;
      saves.append(button);
    }
    header.append(keys, saves);
    header.after(this.node);
    this.listen();
  }

  bin(time) { return Math.max(0, Math.min(this.about.curves[0].low.length - 1, Math.floor(time / this.bin_s + 1e-6))); }
  x(time) { return kMargin.left + (time - this.time.from) / this.time.span * this.inner; }
  timeAt(clientX) {
    const box = this.node.getBoundingClientRect();
    return this.time.from + (clientX - box.left - kMargin.left) / this.inner * this.time.span;
  }
  /** Least and greatest of the curves that are shown, in the window. */
  range() {
    let low = 0, high = 0;
    const first = this.bin(this.time.from), last = this.bin(this.time.to);
    this.about.curves.forEach((curve, k) => {
      if (this.hidden.has(k)) return;
      for (let i = first; i <= last; ++i) {
        if (curve.low[i] < low) low = curve.low[i];
        if (curve.high[i] > high) high = curve.high[i];
      }
    });
    if (!(high - low > 1e-9)) high = low + 1;
    return [low < 0 ? low - 0.04 * (high - low) : 0, high + 0.06 * (high - low)];
  }
  /** The pieces of a line: a point a bin, or the least and the greatest of each pixel. */
  pieces(curve, y) {
    const first = Math.max(0, this.bin(this.time.from) - 1), last = Math.min(curve.low.length - 1, this.bin(this.time.to) + 1);
    const stride = Math.max(1, Math.floor((last - first + 1) / this.inner)), pieces = [];
    let piece = null;
    for (let i = first; i <= last; i += stride) {
      let low = Infinity, high = -Infinity, lowAt = i, highAt = i;
      for (let j = i; j < Math.min(i + stride, last + 1); ++j) {
        if (curve.low[j] < low) low = curve.low[j], lowAt = j;
        if (curve.high[j] > high) high = curve.high[j], highAt = j;
      }
      if (low > high) { piece = null; continue; }
      if (!piece) pieces.push(piece = []);
      const x = this.x((i + 0.5 * stride) * this.bin_s).toFixed(1), ys = [y(low), y(high)];
      if (lowAt > highAt) ys.reverse();
      piece.push(`${x},${ys[0].toFixed(1)}`);
      if (Math.abs(ys[0] - ys[1]) > 0.3) piece.push(`${x},${ys[1].toFixed(1)}`);
    }
    return pieces;
  }
  draw() {
    const { about, axis, node, time } = this;
    const width = this.width = Math.max(200, Math.round(node.getBoundingClientRect().width)), height = this.height = width < 600 ? 170 : 190;
    this.inner = width - kMargin.left - kMargin.right;
    const base = height - kMargin.bottom, { left, top } = kMargin, right = width - kMargin.right;
    const [low, high] = this.range();
    const log = v => Math.log(Math.max(v, 1)) / Math.log(Math.max(high, 4));
    const y = v => base - (base - top) * Math.max(0, Math.min(1, about.log ? log(v) : (v - low) / (high - low)));
    node.replaceChildren();
    for (const [key, value] of Object.entries({ viewBox: `0 0 ${width} ${height}`, height, 'font-size': 11.5, 'font-family': 'system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif' }))
      node.setAttribute(key, value);
    const clip = svg('clipPath', { id: `clip-${this.name}-${about.title.replace(/\W/g, '')}` }, node);
    svg('rect', { x: left, y: 0, width: this.inner, height }, clip);
    const ticks = about.log ? [1, 4, 16, 64, 256, 1024, 4096, 16384].filter(v => v < high).map(v => [v, String(v)]) : marks(low, high, 4);
    for (const [value, text] of ticks) {
      svg('line', { x1: left, x2: right, y1: y(value), y2: y(value), stroke: Math.abs(value) < 1e-12 ? 'var(--line)' : 'var(--grid)' }, node);
      svg('text', { x: left - 7, y: y(value) + 4, 'text-anchor': 'end', fill: 'var(--soft)' }, node, text);
    }
    for (const [value, text] of marks(time.from, time.to, Math.max(3, width / 110))) {
      svg('line', { x1: this.x(value), x2: this.x(value), y1: base, y2: base + 4, stroke: 'var(--line)' }, node);
      svg('text', { x: this.x(value), y: base + 17, 'text-anchor': this.x(value) > right - 14 ? 'end' : 'middle', fill: 'var(--soft)' }, node, `${text} s`);
    }
    svg('text', { x: left - 7, y: 10, 'text-anchor': 'end', fill: 'var(--soft)' }, node, about.unit);
    const group = svg('g', { 'clip-path': `url(#${clip.id})` }, node);
    const bar = (spans, attributes) => {
      for (const [from, to] of spans)
        if (to > time.from && from < time.to) svg('rect', { x: this.x(from), width: Math.max(0.6, this.x(to) - this.x(from)), ...attributes }, group);
    };
    bar(axis.off, { y: top, height: base - top, fill: 'var(--third)', 'fill-opacity': 0.13 });
    if (this.isFirst) {
      bar(axis.contact, { y: base - 3, height: 3, fill: 'var(--second)' });
      bar(axis.guide, { y: top - 4, height: 3, fill: 'var(--good)' });
    }
    about.curves.forEach((curve, k) => {
      if (this.hidden.has(k)) return;
      for (const piece of this.pieces(curve, y)) {
        const foot = p => `${p.split(',')[0]},${y(0).toFixed(1)}`;
        if (curve.area) svg('polygon', { points: [foot(piece[0]), ...piece, foot(piece[piece.length - 1])].join(' '), fill: curve.colour, 'fill-opacity': 0.14 }, group);
        svg('polyline', { 'data-series': k, points: piece.join(' '), fill: 'none', stroke: curve.colour, 'stroke-width': curve.width, 'stroke-linejoin': 'round' }, group);
      }
    });
    const halo = { 'paint-order': 'stroke', stroke: 'var(--card)', 'stroke-width': 4, fill: 'var(--bad)' };
    for (const [at, text] of axis.events) {
      svg('line', { x1: this.x(at), x2: this.x(at), y1: top, y2: base, stroke: 'var(--bad)', 'stroke-dasharray': '2 3' }, group);
      const end = this.x(at) > width * 0.6;
      if (at >= time.from && at <= time.to) svg('text', { x: this.x(at) + (end ? -5 : 5), y: top + 11, 'text-anchor': end ? 'end' : 'start', ...halo }, group, text);
    }
    this.cursor = svg('line', { class: 'cursor', y1: top, y2: base, stroke: 'var(--ink)', 'stroke-opacity': 0.55 }, group);
    this.showCursor();
  }
  showCursor() {
    const { time, about } = this, i = this.bin(time.cursor);
    this.cursor.setAttribute('x1', this.x(time.cursor));
    this.cursor.setAttribute('x2', this.x(time.cursor));
    about.curves.forEach((curve, k) => { this.values[k].textContent = `${curve.high[i].toFixed(about.decimals)} ${about.unit}`; });
  }
  saveSvg() {
    const style = getComputedStyle(document.documentElement);
    const copy = this.node.cloneNode(true), head = 24;
    copy.querySelector('.cursor').remove();
    copy.setAttribute('viewBox', `0 ${-head} ${this.width} ${this.height + head}`);
    copy.setAttribute('height', this.height + head);
    copy.setAttribute('width', this.width);
    const shown = this.about.curves.filter((_, k) => !this.hidden.has(k));
    copy.prepend(svg('rect', { x: 0, y: -head, width: '100%', height: '100%', fill: 'var(--card)' }));
    const title = svg('text', { x: 12, y: -6, fill: 'var(--ink)', 'font-size': 14, 'font-weight': 620 }, copy, `${this.about.title}  `);
    for (const curve of shown) svg('tspan', { fill: curve.colour, 'font-size': 12, 'font-weight': 400 }, title, `\u2003\u2014 ${curve.label}`);
    copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
    const text = copy.outerHTML.replace(/var\((--\w+)\)/g, (_, name) => style.getPropertyValue(name).trim());
    save(`${this.name} ${this.about.title}.svg`, 'image/svg+xml', text);
    return text;
  }
  /** A row a bin; where a bin holds several ticks, their least and greatest value. */
  saveCsv() {
    const { curves, unit } = this.about, isExact = curves.every(c => c.high === c.low);
    const names = curves.map(c => `"${c.label} (${unit})"`);
    const rows = [['time_s', ...(isExact ? names : names.flatMap(n => [n.replace(/"$/, ' least"'), n.replace(/"$/, ' greatest"')]))].join(',')];
    const digits = v => Number.isNaN(v) ? '' : String(Number(v.toPrecision(8)));
    for (let i = this.bin(this.time.from); i <= this.bin(this.time.to); ++i)
      rows.push([(i * this.bin_s).toFixed(6), ...curves.flatMap(c => isExact ? [digits(c.low[i])] : [digits(c.low[i]), digits(c.high[i])])].join(','));
    const text = rows.join('\n') + '\n';
    save(`${this.name} ${this.about.title}.csv`, 'text/csv', text);
    return text;
  }
  // As a map: drag moves, wheel and pinch zoom, a double click shows all.
  listen() {
    const { node, time } = this, pointers = new Map();
    let dragged = false;
    const spread = () => { const xs = [...pointers.values()]; return xs.length > 1 ? Math.abs(xs[0] - xs[1]) : 0; };
    const middle = () => [...pointers.values()].reduce((s, x) => s + x, 0) / pointers.size;
    node.addEventListener('pointerdown', e => {
      pointers.set(e.pointerId, e.clientX);
      dragged = false;
      node.focus({ preventScroll: true });
      try { node.setPointerCapture(e.pointerId); } catch { /* made by a script */ }
    });
    node.addEventListener('pointermove', e => {
      if (!pointers.has(e.pointerId)) { if (e.pointerType !== 'touch') time.set(this.timeAt(e.clientX)); return; }
      const before = middle(), beforeSpread = spread();
      pointers.set(e.pointerId, e.clientX);
      dragged = dragged || Math.abs(middle() - before) > 1;
      if (pointers.size > 1 && beforeSpread > 10) time.zoom(beforeSpread / Math.max(10, spread()), this.timeAt(middle()));
      if (time.isZoomed) time.pan((before - middle()) / this.inner * time.span);
      else time.set(this.timeAt(e.clientX));
    });
    const release = e => {
      if (!dragged && pointers.size === 1 && e.type === 'pointerup') time.set(this.timeAt(e.clientX));
      pointers.delete(e.pointerId);
    };
    node.addEventListener('pointerup', release);
    node.addEventListener('pointercancel', release);
    node.addEventListener('dblclick', () => time.all());
    node.addEventListener('wheel', e => {
      const isSide = Math.abs(e.deltaX) > Math.abs(e.deltaY);
      if (!isSide && document.activeElement !== node) return;  // scrolls the page
      e.preventDefault();
      if (isSide) time.pan(e.deltaX / this.inner * time.span);
      else time.zoom(Math.exp(e.deltaY * 0.002), this.timeAt(e.clientX));
    }, { passive: false });
    node.addEventListener('keydown', e => {
      const side = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
      if (side) e.shiftKey ? time.pan(side * time.span / 10) : time.set(time.cursor + side * Math.max(this.bin_s, time.span / this.inner));
      else if (e.key === '+') time.zoom(0.5);
      else if (e.key === '-') time.zoom(2);
      else if (e.key === 'Home') time.all();
      else return;
      e.preventDefault();
    });
  }
}
