'use strict';
// Close-up of the contact below the 3D view, turned as the view is: the planes that hold the proxy, the spring from the hand to
// it, and the cone of friction. The hand is always drawn equally far from the proxy; the text says how far it is.
class CloseUp {
  static texts = {
    '-': 'No contact.',
    0: 'No plane is known in this tick.',
    i: 'The tool is inside the part: no proxy until it is out.',
    p: 'Penalty contact has no proxy; its plane is not recorded.',
  };
  static hand = 62;  // pixels of the page, from the proxy

  constructor(canvas, held) {
    this.canvas = canvas;
    this.held = held;
    this.vectors = View3d.vectors(held.vectors, 1);
    let at = 0;
    this.first = [...held.kinds].map(kind => { const first = at; if (kind >= '1' && kind <= '3') at += 1 + Number(kind); return first; });
  }
  static dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static sum(a, s, b) { return a.map((x, k) => x * s + b[k]); }
  static cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
  static unit(a) { const n = Math.hypot(...a) || 1; return a.map(x => x / n); }
  static axesAcross(n) {
    const u = CloseUp.unit(CloseUp.cross(n, Math.abs(n[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
    return [u, CloseUp.cross(n, u)];
  }

  // Of a sample: the planes' normals; the hand from the proxy, in its own length; `across`: what of it the planes bear. A proxy
  // on one plane slides along two axes, between two planes along one, in a corner along none.
  show(i) {
    const { dot, sum, cross, unit } = CloseUp, kind = this.held.kinds[i], count = Number(kind) || 0, first = this.first[i];
    const output = this.canvas.parentNode.querySelector('output');
    output.textContent = CloseUp.texts[kind];
    this.normals = this.vectors.slice(first + 1, first + 1 + count).map(unit);
    if (count === 0) return;
    const off = this.vectors[first], n = this.normals;
    this.hand = unit(off);
    this.axes = count === 1 ? CloseUp.axesAcross(n[0]) : count === 2 ? [unit(cross(n[0], n[1]))] : [];
    this.across = this.axes.reduce((rest, axis) => sum(axis, -dot(rest, axis), rest), this.hand);
    this.friction = this.held.friction.filter(([from]) => from <= i).pop().slice(1);
    this.along = Math.hypot(...sum(this.across, -1, this.hand)) / Math.hypot(...this.across);
    const [mu, slide] = this.friction.map(v => v.toFixed(2));
    output.textContent = `The hand is ${(Math.hypot(...off) * this.held.farthest_mm).toFixed(2)} mm from the proxy. ` +
      (this.axes.length ? `Pull along over pull across: ${this.along.toFixed(2)}; ` : 'On three planes the proxy cannot slide; ') +
      `friction ${mu}${slide === mu ? '' : `, sliding ${slide}`}.`;
  }
  // The part of a square in the plane through the proxy that is in front of the other planes.
  patch(n) {
    const { dot, sum } = CloseUp, size = 1.05, [u, v] = CloseUp.axesAcross(n);
    let shape = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => sum(u, a * size, v.map(x => x * b * size)));
    for (const other of this.normals) if (other !== n) {
      shape = shape.flatMap((p, i) => {
        const q = shape[(i + 1) % shape.length], a = dot(p, other), b = dot(q, other);
        return [...(a >= 0 ? [p] : []), ...((a < 0) !== (b < 0) ? [sum(sum(p, -1, q), a / (a - b), p)] : [])];
      });
    }
    return shape;
  }
  // The cone where the hand is: a circle on one plane, a stretch along the edge between two.
  ring(friction) {
    const { sum } = CloseUp, radius = friction * Math.hypot(...this.across), [u, v = [0, 0, 0]] = this.axes;
    return Array.from({ length: 48 }, (_, i) => i * Math.PI / 24).map(turn =>
      sum(u, radius * Math.cos(turn), sum(v, radius * Math.sin(turn), this.across)));
  }
  draw({ f, ratio }) {
    const { dot } = CloseUp, { canvas } = this, box = canvas.getBoundingClientRect(), g = canvas.getContext('2d');
    canvas.width = box.width * ratio;
    canvas.height = box.height * ratio;
    const scale = CloseUp.hand * ratio, see = p => [canvas.width / 2 + dot(p, f.right) * scale, canvas.height / 2 - dot(p, f.up) * scale];
    const line = (points, colour, width, fill, dash = []) => {
      g.beginPath();
      points.map(see).forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y)));
      if (fill) { g.closePath(); g.fillStyle = fill; g.fill(); }
      g.setLineDash(dash.map(d => d * ratio));
      g.strokeStyle = colour;
      g.lineWidth = width * ratio;
      g.stroke();
    };
    const disc = (p, radius, colour) => {
      g.beginPath();
      g.arc(...see(p), radius * ratio, 0, 7);
      g.fillStyle = colour;
      g.fill();
    };
    const plane = n => line(this.patch(n), '#1f8a5b', 1, 'rgba(31, 138, 91, 0.2)');
    const isFront = n => dot(n, f.eye) > 0;  // the hand is behind it
    if (!this.normals.length) return;
    this.normals.filter(n => !isFront(n)).forEach(plane);
    const [ax, ay] = see([0, 0, 0]), [cx, cy] = see(this.across), aside = p => { const [x, y] = see(p); return (cx - ax) * (y - ay) - (cy - ay) * (x - ax); };
    this.friction.forEach((friction, i) => {
      if (!(friction > 0) || !this.axes.length || (i === 1 && friction === this.friction[0])) return;
      const ring = this.ring(friction), dash = i === 1 ? [4, 3] : [];
      line([...ring, ring[0]], '#e2742b', 1.5, i === 0 ? 'rgba(226, 116, 43, 0.22)' : null, dash);
      for (const s of [1, -1]) line([[0, 0, 0], ring.reduce((a, b) => (s * aside(b) > s * aside(a) ? b : a))], '#e2742b', 1.5, null, dash);
    });
    line([[0, 0, 0], this.hand], '#c62839', 2.5);
    disc(this.hand, 5, '#7e8aa0');
    this.normals.filter(isFront).forEach(plane);
    for (const n of this.normals.map(v => v.map(x => x * 0.8))) {
      line([[0, 0, 0], n], '#1f8a5b', 2.5);
      disc(n, 3.5, '#1f8a5b');
    }
    disc([0, 0, 0], 6, '#2563eb');
  }
}
