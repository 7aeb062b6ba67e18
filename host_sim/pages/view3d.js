'use strict';
// 3D view of a page, drawn by a small rasterizer on a 2D canvas: it works without WebGL. Part and paths are drawn when
// the view turns; the tool, its force and a trail at every change. Positions are in radii about the scene's centre.
class View3d {
  static first = { azimuth: 0.72, elevation: 0.52, zoom: 1, x: 0, y: 0, yUp: false };  // as in report/draw.cpp

  constructor(canvas, scene, hidden = []) {
    this.canvas = canvas;
    this.scene = scene;
    this.view = { ...View3d.first };
    this.hidden = new Set(hidden);
    this.tool = null;   // centre
    this.tilt = [0, 0, 0];  // rotation vector of its spheres
    this.force = null;  // in radii
    this.trail = [];    // points
    this.links = [];    // points of chains, null between them
    this.off = document.createElement('canvas');
    this.key = '';
    this.reach = [];    // points that the initial view has room for
    this.moving = false;
    this.unpack();
    this.fit = this.fitted(1000, 700);
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
    this.draw();
  }
  useLegend() {  // check boxes of the paths, and which axis is up
    for (const box of document.querySelectorAll('input[data-path]')) {
      box.checked = !this.hidden.has(box.dataset.path);
      box.onchange = () => { this.hidden[box.checked ? 'delete' : 'add'](box.dataset.path); this.draw(); };
    }
    document.getElementById('upright').onchange = e => this.reset(e.target.checked);
  }
  static bytes(text) { return Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer; }
  static vectors(text, reach) {
    const packed = new Int16Array(View3d.bytes(text)), list = [];
    for (let i = 0; i < packed.length; i += 3)
      list.push(packed[i] === -32768 ? null : [0, 1, 2].map(k => packed[i + k] / 32767 * reach));
    return list;
  }
  unpack() {
    const { mesh, paths } = this.scene;
    this.points = Float32Array.from(new Int16Array(View3d.bytes(mesh.vertices)), v => v / 32767);
    this.corners = mesh.wide ? new Uint32Array(View3d.bytes(mesh.triangles)) : new Uint16Array(View3d.bytes(mesh.triangles));
    this.paths = paths.map(path => ({ ...path, points: View3d.vectors(path.points, 4) })).filter(path => !path.joints);
    this.linkStyle = paths.find(path => path.joints) || { key: 'links', colour: '#8068c4', width: 5 };
    // Normals of faces and vertices; sharp corners are shaded flat.
    const { points, corners } = this, face = new Float32Array(corners.length), vertex = new Float32Array(points.length);
    for (let t = 0; t < corners.length; t += 3) {
      const [a, b, c] = [corners[t] * 3, corners[t + 1] * 3, corners[t + 2] * 3];
      const u = [0, 1, 2].map(k => points[b + k] - points[a + k]), v = [0, 1, 2].map(k => points[c + k] - points[a + k]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const length = Math.hypot(...n) || 1;
      for (let k = 0; k < 3; ++k) {
        face[t + k] = n[k] / length;
        for (const corner of [a, b, c]) vertex[corner + k] += n[k];
      }
    }
    for (let i = 0; i < vertex.length; i += 3) {
      const length = Math.hypot(vertex[i], vertex[i + 1], vertex[i + 2]) || 1;
      for (let k = 0; k < 3; ++k) vertex[i + k] /= length;
    }
    this.faceNormals = face;
    this.vertexNormals = vertex;
  }

  frame() {
    const v = this.view, ca = Math.cos(v.azimuth), sa = Math.sin(v.azimuth), ce = Math.cos(v.elevation), se = Math.sin(v.elevation);
    const stood = p => v.yUp ? [p[0], p[2], -p[1]] : p;  // many models have y up
    const sum = (a, s, b, t, c, u) => a.map((x, i) => x * s + b[i] * t + c[i] * u);
    const unit = p => { const n = Math.hypot(...p) || 1; return p.map(x => x / n); };
    const right = stood([ca, sa, 0]), eye = stood([sa * ce, -ca * ce, se]), up = stood([-sa * se, ca * se, ce]);
    const key = unit(sum(eye, 0.62, up, 0.62, right, -0.48)), fill = unit(sum(eye, 0.5, up, -0.3, right, 0.8));
    return { right, up, eye, key, fill, half: unit(sum(key, 1, eye, 1, eye, 0)) };
  }
  // Brightness for a normal, 0 to 1.5; a highlight above 1.
  static light(f, x, y, z) {
    const at = v => x * v[0] + y * v[1] + z * v[2];
    const facing = Math.max(0, at(f.eye)), rim = 1 - facing, shine = Math.max(0, at(f.half));
    return 0.34 + 0.62 * Math.max(0, at(f.key)) + 0.16 * Math.max(0, at(f.fill)) - 0.12 * rim * rim * rim + 0.2 * shine ** 40;
  }
  static shades(base) {
    return Uint32Array.from({ length: 512 }, (_, i) => {
      const c = base.map(v => Math.min(255, Math.round(v * Math.min(i / 340, 1.08) + Math.max(0, i / 340 - 1.08) * 120)));
      return (255 << 24 | c[2] << 16 | c[1] << 8 | c[0]) >>> 0;
    });
  }
  static partShades = View3d.shades([176, 186, 201]);
  static touchedShades = View3d.shades([140, 176, 214]);
  static toolShades = View3d.shades([96, 150, 255]);
  static shade(table, l) { return table[Math.max(0, Math.min(511, (l * 340) | 0))]; }

  // Screen of a point: x, y in pixels of the drawing, depth towards the eye.
  see(p) {
    const { f, w, h, scale, view } = this, at = v => p[0] * v[0] + p[1] * v[1] + p[2] * v[2];
    return [w / 2 + (at(f.right) + view.x) * scale, h / 2 - (at(f.up) + view.y) * scale, at(f.eye) * scale];
  }
  put(i, z, colour) {
    if (z < this.depth[i]) return;
    this.depth[i] = z;
    this.pixels[i] = colour;
  }
  drawTriangles() {
    const { points, corners, faceNormals: face, vertexNormals: vertex, f, w, h } = this, count = points.length / 3;
    const touched = this.scene.mesh.touched || [];
    const sx = new Float32Array(count), sy = new Float32Array(count), sz = new Float32Array(count), lit = new Float32Array(count);
    for (let i = 0, j = 0; i < count; ++i, j += 3) {
      [sx[i], sy[i], sz[i]] = this.see([points[j], points[j + 1], points[j + 2]]);
      lit[i] = View3d.light(f, vertex[j], vertex[j + 1], vertex[j + 2]);
    }
    for (let t = 0; t < corners.length; t += 3) {
      const a = corners[t], b = corners[t + 1], c = corners[t + 2];
      const area = (sx[b] - sx[a]) * (sy[c] - sy[a]) - (sx[c] - sx[a]) * (sy[b] - sy[a]);
      if (area === 0) continue;
      const shades = touched.some(([first, end]) => t >= 3 * first && t < 3 * end) ? View3d.touchedShades : View3d.partShades;
      const nx = face[t], ny = face[t + 1], nz = face[t + 2];
      const back = nx * f.eye[0] + ny * f.eye[1] + nz * f.eye[2] < 0;
      if (back && this.scene.mesh.closed) continue;
      const flat = back ? View3d.light(f, -nx, -ny, -nz) : View3d.light(f, nx, ny, nz);
      const corner = i => !back && nx * vertex[3 * i] + ny * vertex[3 * i + 1] + nz * vertex[3 * i + 2] > 0.82 ? lit[i] : flat;
      const la = corner(a), lb = corner(b), lc = corner(c);
      const x0 = Math.max(0, Math.ceil(Math.min(sx[a], sx[b], sx[c]) - 0.5));
      const x1 = Math.min(w - 1, Math.floor(Math.max(sx[a], sx[b], sx[c]) - 0.5));
      const y0 = Math.max(0, Math.ceil(Math.min(sy[a], sy[b], sy[c]) - 0.5));
      const y1 = Math.min(h - 1, Math.floor(Math.max(sy[a], sy[b], sy[c]) - 0.5));
      const dbx = (sy[c] - sy[a]) / area, dcx = -(sy[b] - sy[a]) / area;
      for (let y = y0; y <= y1; ++y) {
        let wb = ((x0 + 0.5 - sx[a]) * (sy[c] - sy[a]) - (sx[c] - sx[a]) * (y + 0.5 - sy[a])) / area;
        let wc = ((sx[b] - sx[a]) * (y + 0.5 - sy[a]) - (x0 + 0.5 - sx[a]) * (sy[b] - sy[a])) / area;
        for (let x = x0, i = y * w + x0; x <= x1; ++x, ++i, wb += dbx, wc += dcx) {
          const wa = 1 - wb - wc;
          if (wa < 0 || wb < 0 || wc < 0) continue;
          const z = wa * sz[a] + wb * sz[b] + wc * sz[c];
          if (z < this.depth[i]) continue;
          this.depth[i] = z;
          this.pixels[i] = View3d.shade(shades, wa * la + wb * lb + wc * lc);
        }
      }
    }
  }
  disc(x, y, z, radius, colour) {
    const reach = Math.ceil(radius), r2 = radius * radius;
    for (let dy = -reach; dy <= reach; ++dy) for (let dx = -reach; dx <= reach; ++dx) {
      const px = Math.round(x) + dx, py = Math.round(y) + dy;
      if (dx * dx + dy * dy <= r2 && px >= 0 && py >= 0 && px < this.w && py < this.h) this.put(py * this.w + px, z, colour);
    }
  }
  static abgr(hex) { return (255 << 24 | parseInt(hex.slice(5, 7), 16) << 16 | parseInt(hex.slice(3, 5), 16) << 8 | parseInt(hex.slice(1, 3), 16)) >>> 0; }
  // A line is a row of discs, slightly in front of the surface.
  drawPath(path, ratio) {
    const radius = path.width * ratio / 2;
    let before = null;
    path.points.forEach((p, i) => {
      const now = p ? this.see(p) : null;
      if (before && now) {
        const colour = View3d.abgr(path.colours ? path.colours[i] : path.colour);
        const steps = Math.min(4000, Math.ceil(Math.hypot(now[0] - before[0], now[1] - before[1]) / Math.max(0.5, radius / 2)) + 1);
        for (let s = 0; s <= steps; ++s) {
          const q = before.map((v, k) => v + (now[k] - v) * s / steps);
          this.disc(q[0], q[1], q[2] + 2 * radius + ratio, radius, colour);
        }
      }
      before = now;
    });
  }
  drawLinks(ratio) {
    const radius = this.linkStyle.width * ratio / 2;
    this.drawPath({ ...this.linkStyle, points: this.links }, ratio);
    for (const p of this.links.filter(Boolean)) {
      const [x, y, z] = this.see(p);
      this.disc(x, y, z + 2 * radius + ratio, 1.8 * radius, View3d.abgr(this.linkStyle.colour));  // as in report/draw.cpp
    }
  }
  // By the rotation vector `by`: Rodrigues' formula.
  static turned(v, by) {
    const angle = Math.hypot(...by);
    if (!(angle > 0)) return v;
    const a = by.map(c => c / angle), s = Math.sin(angle), c = Math.cos(angle), along = a[0] * v[0] + a[1] * v[1] + a[2] * v[2];
    const across = [a[1] * v[2] - a[2] * v[1], a[2] * v[0] - a[0] * v[2], a[0] * v[1] - a[1] * v[0]];
    return v.map((x, k) => x * c + across[k] * s + a[k] * along * (1 - c));
  }
  drawTool() {
    const { spheres, toolRadius } = this.scene;
    if (!spheres || spheres.length === 0) return this.drawSphere(this.tool, toolRadius);
    for (const [x, y, z, r] of spheres)
      this.drawSphere(View3d.turned([x, y, z], this.tilt).map((v, k) => v + this.tool[k]), r);
  }
  drawSphere(centre, size) {
    const [cx, cy, cz] = this.see(centre), { f, w, h } = this;
    const radius = Math.max(2, size * this.scale), reach = Math.ceil(radius);
    for (let dy = -reach; dy <= reach; ++dy) for (let dx = -reach; dx <= reach; ++dx) {
      const rest = radius * radius - dx * dx - dy * dy, px = Math.round(cx) + dx, py = Math.round(cy) + dy;
      if (rest < 0 || px < 0 || py < 0 || px >= w || py >= h) continue;
      const up = Math.sqrt(rest), n = f.right.map((r, k) => (r * dx - f.up[k] * dy + f.eye[k] * up) / radius);
      this.put(py * w + px, cz + up, View3d.shade(View3d.toolShades, View3d.light(f, n[0], n[1], n[2])));
    }
  }
  // Over everything: the force acts at the tool's centre, which the part may hide.
  drawForce(g, over) {
    if (!this.tool || !this.force || Math.hypot(...this.force) < 0.004) return;
    const [x0, y0] = this.see(this.tool).map(v => v / over), [x1, y1] = this.see(this.tool.map((v, k) => v + this.force[k])).map(v => v / over);
    const length = Math.hypot(x1 - x0, y1 - y0) || 1, ux = (x1 - x0) / length, uy = (y1 - y0) / length;
    const thick = 3 * this.ratio, head = Math.min(length, 5 * thick);
    for (const [colour, width] of [['#ffffff', thick + 2 * this.ratio], ['#c62839', thick]]) {
      const grown = (width - thick) / 2;
      g.strokeStyle = g.fillStyle = colour;
      g.lineWidth = width;
      g.beginPath();
      g.moveTo(x0, y0);
      g.lineTo(x1 - ux * head * 0.8, y1 - uy * head * 0.8);
      g.stroke();
      g.beginPath();
      g.moveTo(x1 + ux * 2 * grown, y1 + uy * 2 * grown);
      for (const side of [1, -1])
        g.lineTo(x1 - ux * (head + grown) - side * uy * (head * 0.45 + grown), y1 - uy * (head + grown) + side * ux * (head * 0.45 + grown));
      g.fill();
    }
  }

  // Pixels per radius at which the whole scene fits into the initial view.
  fitted(w, h) {
    const now = this.view;
    this.view = { ...View3d.first, yUp: now.yUp };
    const f = this.frame();
    this.view = now;
    let x = 0.05, y = 0.05;
    const take = (px, py, pz) => {
      x = Math.max(x, Math.abs(px * f.right[0] + py * f.right[1] + pz * f.right[2]));
      y = Math.max(y, Math.abs(px * f.up[0] + py * f.up[1] + pz * f.up[2]));
    };
    for (let j = 0; j < this.points.length; j += 3) take(this.points[j], this.points[j + 1], this.points[j + 2]);
    for (const path of this.paths) for (const p of path.points) if (p) take(...p);
    for (const p of this.reach) take(...p);
    return 0.45 * Math.min(w / x, h * 0.94 / y);
  }
  render() {
    this.queued = false;
    const box = this.canvas.getBoundingClientRect(), ratio = this.ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.round(box.width * ratio), height = Math.round(box.height * ratio);
    if (width < 2 || height < 2) return;
    const over = this.moving || width * height > 2.5e6 ? 1 : 2;  // antialiasing at rest
    const w = this.w = width * over, h = this.h = height * over, size = w * h;
    this.f = this.frame();
    this.scale = this.fit * Math.min(w / 1000, h / 700) * this.view.zoom;
    const key = JSON.stringify([w, h, this.view, [...this.hidden]]);
    if (key !== this.key) {
      this.key = key;
      this.off.width = w;
      this.off.height = h;
      this.image = this.off.getContext('2d').createImageData(w, h);
      this.pixels = new Uint32Array(size);
      this.depth = new Float32Array(size).fill(-Infinity);
      this.drawTriangles();
      for (const path of this.paths) if (!this.hidden.has(path.key)) this.drawPath(path, ratio * over);
      this.still = { pixels: this.pixels, depth: this.depth };
    }
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.pixels.set(this.still.pixels);
    this.depth = this.still.depth.slice();
    if (this.trail.length > 1) this.drawPath({ colour: '#2563eb', width: 2, points: this.trail }, ratio * over);
    if (!this.hidden.has('links')) this.drawLinks(ratio * over);
    if (this.tool) this.drawTool();
    this.off.getContext('2d').putImageData(this.image, 0, 0);
    this.canvas.width = width;
    this.canvas.height = height;
    const g = this.canvas.getContext('2d');
    g.imageSmoothingQuality = 'high';
    g.drawImage(this.off, 0, 0, width, height);
    this.drawForce(g, over);
    if (this.closeUp) this.closeUp.draw(this);
  }
  draw() {
    if (this.queued) return;
    this.queued = true;
    requestAnimationFrame(() => this.render());
  }
  setTool(centre, force, tilt = [0, 0, 0], links = []) { Object.assign(this, { tool: centre, force, tilt, links }); this.draw(); }
  /** The initial view has room for these points, too. */
  makeRoom(points) {
    this.reach = this.reach.concat(points);
    this.fit = this.fitted(1000, 700);
    this.draw();
  }
  turn(azimuth, elevation, zoom) {
    const v = this.view;
    v.azimuth += azimuth;
    v.elevation = Math.max(-1.57, Math.min(1.57, v.elevation + elevation));
    v.zoom = Math.max(0.4, Math.min(40, v.zoom * zoom));
    this.draw();
  }
  // By pixels of the page.
  move(dx, dy) {
    const page = this.scale * this.canvas.getBoundingClientRect().width / this.w;
    this.view.x += dx / page;
    this.view.y -= dy / page;
    this.draw();
  }
  reset(yUp = this.view.yUp) {
    this.view = { ...View3d.first, yUp };
    this.fit = this.fitted(1000, 700);
    this.draw();
  }
  listen() {
    const { canvas } = this, pointers = new Map();
    const middle = () => {
      const all = [...pointers.values()], x = all.reduce((s, p) => s + p.x, 0) / all.length, y = all.reduce((s, p) => s + p.y, 0) / all.length;
      return { x, y, spread: all.length > 1 ? Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) : 0 };
    };
    canvas.addEventListener('pointerdown', e => {
      pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      this.moving = true;
      try { canvas.setPointerCapture(e.pointerId); } catch { /* made by a script */ }
      canvas.focus({ preventScroll: true });
    });
    canvas.addEventListener('pointermove', e => {
      if (!pointers.has(e.pointerId)) return;
      const before = middle();
      pointers.set(e.pointerId, { x: e.clientX, y: e.clientY });
      const now = middle(), dx = now.x - before.x, dy = now.y - before.y;
      if (pointers.size > 1) {
        if (before.spread > 10) this.turn(0, 0, now.spread / before.spread);
        this.move(dx, dy);
      } else if (e.shiftKey || (e.buttons & 6) !== 0) this.move(dx, dy);
      else this.turn(-dx * 0.009, dy * 0.009, 1);
    });
    const release = e => { pointers.delete(e.pointerId); this.moving = pointers.size > 0; this.draw(); };
    canvas.addEventListener('pointerup', release);
    canvas.addEventListener('pointercancel', release);
    canvas.addEventListener('contextmenu', e => e.preventDefault());
    canvas.addEventListener('dblclick', () => this.reset());
    // The wheel scrolls the page unless the view has the focus.
    canvas.addEventListener('wheel', e => {
      if (document.activeElement !== canvas) return;
      e.preventDefault();
      this.turn(0, 0, Math.exp(-e.deltaY * 0.0012));
    }, { passive: false });
    canvas.addEventListener('keydown', e => {
      const turn = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1],
        '+': [0, 0, 1.2], '-': [0, 0, 1 / 1.2] }[e.key];
      if (!turn) return;
      e.preventDefault();
      if (e.shiftKey && e.key.startsWith('Arrow')) this.move(-turn[0] * 200, -turn[1] * 200);
      else this.turn(...turn);
    });
  }
}
