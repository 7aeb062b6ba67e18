'use strict';
// Where the joints of a linkage are if its tip is at a point, all in metres and radians of the device frame.
// A chain has a driven link, which turns about `base` in the plane of `out` and `up`, and a rod from its end, the elbow, to the tip.
class Linkage {
  // of: { chains: [{ base, out, up, link, rod, range }], turntable: range or null, second: range or null, isRelative, side }
  // turntable: what turns the one chain of an arm about z. second: of an arm's second joint, which is the rod's angle. side: of a
  // loop's tip beside its elbows, 1 or -1.
  constructor(of) { Object.assign(this, of); }

  static dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static minus(a, b) { return a.map((v, k) => v - b[k]); }
  static cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
  /** An angle of a range, whole turns beside `angle`, and how far it is from the middle; null: there is none. */
  static within([low, high], angle) {
    const middle = (low + high) / 2, off = angle - middle, near = off - 2 * Math.PI * Math.round(off / (2 * Math.PI));
    return Math.abs(near) <= (high - low) / 2 + 1e-6 ? { angle: middle + near, off: Math.abs(near) } : null;
  }

  /** Elbow and angles of a chain; of two elbows the one whose angle is nearer to the middle of its range. */
  reach(chain, tip, turn) {
    const c = Math.cos(turn), s = Math.sin(turn), about = ([x, y, z]) => [c * x - s * y, s * x + c * y, z];
    const base = about(chain.base), out = about(chain.out), up = about(chain.up), way = Linkage.minus(tip, base);
    const x = Linkage.dot(way, out), y = Linkage.dot(way, up);
    const bend = Math.acos((Linkage.dot(way, way) + chain.link ** 2 - chain.rod ** 2) / (2 * chain.link * Math.hypot(x, y)));
    let best = null;
    for (const angle of [Math.atan2(y, x) + bend, Math.atan2(y, x) - bend]) {
      const first = Linkage.within(chain.range, angle);
      if (!first) continue;
      const elbow = base.map((v, k) => v + chain.link * (Math.cos(first.angle) * out[k] + Math.sin(first.angle) * up[k]));
      const rod = Linkage.minus(tip, elbow), rodAngle = Math.atan2(Linkage.dot(rod, up), Linkage.dot(rod, out));
      const second = this.second && Linkage.within(this.second, rodAngle - (this.isRelative ? first.angle : 0));
      if (this.second && !second) continue;
      if (!best || first.off < best.off) best = { off: first.off, base, elbow, angles: [first.angle, ...(second ? [second.angle] : [])] };
    }
    return best;
  }

  /** Angles, and [base, elbow] of each chain; null where the tip cannot be. */
  at(tip) {
    const turn = this.turntable ? Linkage.within(this.turntable, Math.atan2(tip[1], tip[0])) : { angle: 0 };
    const chains = turn && this.chains.map(chain => this.reach(chain, tip, turn.angle));
    if (!chains || chains.includes(null)) return null;
    const [a, b, c] = chains.map(chain => chain.elbow);
    if (this.side) {
      const between = Linkage.minus(b, a), across = c ? Linkage.cross(between, Linkage.minus(c, a)) : [-between[1], between[0], 0];
      if (!(Linkage.dot(Linkage.minus(tip, a), across) * this.side > 0)) return null;
    }
    return { angles: [...(this.turntable ? [turn.angle] : []), ...chains.flatMap(chain => chain.angles)], chains: chains.map(chain => [chain.base, chain.elbow]) };
  }

  /** Condition of the Jacobian as firmtouch/device/linkage.hpp has it, n / (|J| |J^-1|), by differences; 0 where the tip cannot be. */
  reciprocalCondition(tip) {
    const n = this.at(tip)?.angles.length, h = 1e-6, rows = [];
    if (!n) return 0;
    for (let k = 0; k < n; ++k) {
      const [above, below] = [h, -h].map(step => this.at(tip.map((v, i) => v + (i === k ? step : 0)))?.angles);
      if (!above || !below) return 0;
      rows.push(Linkage.minus(above, below).map(v => v / (2 * h)));
    }
    // Jacobi's rotations make the rows square to each other.
    for (let sweep = 0; sweep < 8; ++sweep)
      for (let i = 0; i < n; ++i)
        for (let k = i + 1; k < n; ++k) {
          const product = (p, q) => p.reduce((sum, v, m) => sum + v * q[m], 0);
          const turn = Math.atan2(2 * product(rows[i], rows[k]), product(rows[i], rows[i]) - product(rows[k], rows[k])) / 2;
          const c = Math.cos(turn), s = Math.sin(turn), [p, q] = [rows[i], rows[k]];
          rows[i] = p.map((v, m) => c * v + s * q[m]);
          rows[k] = q.map((v, m) => c * v - s * p[m]);
        }
    const sizes = rows.map(row => Math.hypot(...row));
    return n / (Math.hypot(...sizes) * Math.hypot(...sizes.map(v => 1 / v)));
  }
}
