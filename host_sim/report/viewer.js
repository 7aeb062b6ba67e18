'use strict';
// 3D view, drawn by a small rasterizer on a 2D canvas (works without WebGL), and the charts' common time cursor, which
// also moves the tool in the 3D view.
(() => {
  const data = JSON.parse(document.getElementById('run-data').textContent);
  const canvas = document.getElementById('stage');
  const first = {azimuth: 0.72, elevation: 0.52, zoom: 1, yUp: false};  // as in report/draw.cpp
  const view = {...first};
  const hidden = new Set(['tool', 'hand']);
  let cursor = data.series.start, dragging = false, queued = false;

  const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer;
  const packed = new Int16Array(bytes(data.mesh.vertices));
  const corners = data.mesh.wide ? new Uint32Array(bytes(data.mesh.triangles)) : new Uint16Array(bytes(data.mesh.triangles));
  const vertexCount = packed.length / 3, triangleCount = corners.length / 3;
  const points = Float32Array.from(packed, v => v / 32767);

  // Normals of faces and vertices; sharp corners are shaded flat.
  const faceNormals = new Float32Array(triangleCount * 3), vertexNormals = new Float32Array(vertexCount * 3);
  for (let t = 0; t < triangleCount; ++t) {
    const a = corners[3 * t] * 3, b = corners[3 * t + 1] * 3, c = corners[3 * t + 2] * 3;
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(...n) || 1;
    for (let k = 0; k < 3; ++k) {
      faceNormals[3 * t + k] = n[k] / length;
      vertexNormals[a + k] += n[k];
      vertexNormals[b + k] += n[k];
      vertexNormals[c + k] += n[k];
    }
  }
  for (let i = 0; i < vertexNormals.length; i += 3) {
    const length = Math.hypot(vertexNormals[i], vertexNormals[i + 1], vertexNormals[i + 2]) || 1;
    for (let k = 0; k < 3; ++k) vertexNormals[i + k] /= length;
  }

  const unit = v => { const n = Math.hypot(...v) || 1; return v.map(x => x / n); };
  const sum = (a, s, b, t, c, u) => a.map((x, i) => x * s + b[i] * t + c[i] * u);
  function frame() {
    const ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth);
    const ce = Math.cos(view.elevation), se = Math.sin(view.elevation);
    const stood = v => view.yUp ? [v[0], v[2], -v[1]] : v;  // many models have y up
    const right = stood([ca, sa, 0]), eye = stood([sa * ce, -ca * ce, se]), up = stood([-sa * se, ca * se, ce]);
    const key = unit(sum(eye, 0.62, up, 0.62, right, -0.48)), fill = unit(sum(eye, 0.5, up, -0.3, right, 0.8));
    return {right, up, eye, key, fill, half: unit(sum(key, 1, eye, 1, eye, 0))};
  }
  // Brightness for a normal, 0 to 1.5; a highlight above 1.
  function light(f, x, y, z) {
    const at = v => x * v[0] + y * v[1] + z * v[2];
    const facing = Math.max(0, at(f.eye)), rim = 1 - facing, shine = Math.max(0, at(f.half));
    return 0.34 + 0.62 * Math.max(0, at(f.key)) + 0.16 * Math.max(0, at(f.fill)) - 0.12 * rim * rim * rim + 0.2 * shine ** 40;
  }
  const shades = base => Uint32Array.from({length: 512}, (_, i) => {
    const c = base.map(v => Math.min(255, Math.round(v * Math.min(i / 340, 1.08) + Math.max(0, i / 340 - 1.08) * 120)));
    return (255 << 24 | c[2] << 16 | c[1] << 8 | c[0]) >>> 0;
  });
  const partShades = shades([176, 186, 201]), toolShades = shades([96, 150, 255]);
  const shade = (table, l) => table[Math.max(0, Math.min(511, (l * 340) | 0))];

  const off = document.createElement('canvas');
  let depth = new Float32Array(0), image = null, pixels = null;

  function drawTriangles(f, w, h, scale) {
    const sx = new Float32Array(vertexCount), sy = new Float32Array(vertexCount), sz = new Float32Array(vertexCount);
    const lit = new Float32Array(vertexCount);
    for (let i = 0, j = 0; i < vertexCount; ++i, j += 3) {
      const x = points[j], y = points[j + 1], z = points[j + 2];
      sx[i] = w / 2 + (x * f.right[0] + y * f.right[1] + z * f.right[2]) * scale;
      sy[i] = h / 2 - (x * f.up[0] + y * f.up[1] + z * f.up[2]) * scale;
      sz[i] = (x * f.eye[0] + y * f.eye[1] + z * f.eye[2]) * scale;
      lit[i] = light(f, vertexNormals[j], vertexNormals[j + 1], vertexNormals[j + 2]);
    }
    for (let t = 0; t < triangleCount; ++t) {
      const a = corners[3 * t], b = corners[3 * t + 1], c = corners[3 * t + 2];
      const area = (sx[b] - sx[a]) * (sy[c] - sy[a]) - (sx[c] - sx[a]) * (sy[b] - sy[a]);
      if (area === 0) continue;
      const nx = faceNormals[3 * t], ny = faceNormals[3 * t + 1], nz = faceNormals[3 * t + 2];
      const back = nx * f.eye[0] + ny * f.eye[1] + nz * f.eye[2] < 0;
      if (back && data.mesh.closed) continue;
      const flat = back ? light(f, -nx, -ny, -nz) : light(f, nx, ny, nz);
      const corner = i => !back && nx * vertexNormals[3 * i] + ny * vertexNormals[3 * i + 1] + nz * vertexNormals[3 * i + 2] > 0.82
        ? lit[i] : flat;
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
          if (z < depth[i]) continue;
          depth[i] = z;
          pixels[i] = shade(partShades, wa * la + wb * lb + wc * lc);
        }
      }
    }
  }

  function see(f, p, w, h, scale) {
    return [w / 2 + (p[0] * f.right[0] + p[1] * f.right[1] + p[2] * f.right[2]) * scale,
      h / 2 - (p[0] * f.up[0] + p[1] * f.up[1] + p[2] * f.up[2]) * scale,
      (p[0] * f.eye[0] + p[1] * f.eye[1] + p[2] * f.eye[2]) * scale];
  }
  function disc(x, y, z, radius, colour, w, h) {
    const reach = Math.ceil(radius), r2 = radius * radius;
    for (let dy = -reach; dy <= reach; ++dy) for (let dx = -reach; dx <= reach; ++dx) {
      const px = Math.round(x) + dx, py = Math.round(y) + dy;
      if (dx * dx + dy * dy > r2 || px < 0 || py < 0 || px >= w || py >= h) continue;
      const i = py * w + px;
      if (z < depth[i]) continue;
      depth[i] = z;
      pixels[i] = colour;
    }
  }
  const abgr = hex => (255 << 24 | parseInt(hex.slice(5, 7), 16) << 16 | parseInt(hex.slice(3, 5), 16) << 8 | parseInt(hex.slice(1, 3), 16)) >>> 0;
  function drawPath(f, path, w, h, scale, ratio) {
    const radius = path.width * ratio / 2;
    let before = null;
    for (let i = 0; i < path.points.length; ++i) {
      const p = path.points[i];
      const now = p ? see(f, p, w, h, scale) : null;
      if (before && now) {
        const colour = abgr(path.colours ? path.colours[i] : path.colour);
        const steps = Math.min(4000, Math.ceil(Math.hypot(now[0] - before[0], now[1] - before[1]) / Math.max(0.5, radius / 2)) + 1);
        for (let s = 0; s <= steps; ++s) {
          const q = before.map((v, k) => v + (now[k] - v) * s / steps);
          disc(q[0], q[1], q[2] + 2 * radius + ratio, radius, colour, w, h);
        }
      }
      before = now;
    }
  }
  function drawTool(f, w, h, scale) {
    const p = data.series.device[cursor];
    if (!p) return;
    const [cx, cy, cz] = see(f, p, w, h, scale), radius = data.toolRadius * scale, reach = Math.ceil(radius);
    for (let dy = -reach; dy <= reach; ++dy) for (let dx = -reach; dx <= reach; ++dx) {
      const rest = radius * radius - dx * dx - dy * dy, px = Math.round(cx) + dx, py = Math.round(cy) + dy;
      if (rest < 0 || px < 0 || py < 0 || px >= w || py >= h) continue;
      const up = Math.sqrt(rest), i = py * w + px;
      if (cz + up < depth[i]) continue;
      depth[i] = cz + up;
      const n = f.right.map((r, k) => (r * dx - f.up[k] * dy + f.eye[k] * up) / radius);
      pixels[i] = shade(toolShades, light(f, n[0], n[1], n[2]));
    }
  }

  // Pixels per unit at which the whole scene fits into the initial view.
  function fitted(w, h) {
    const now = {...view};
    Object.assign(view, first, {yUp: now.yUp});
    const f = frame();
    Object.assign(view, now);
    let x = 0.05, y = 0.05;
    const take = (px, py, pz) => {
      x = Math.max(x, Math.abs(px * f.right[0] + py * f.right[1] + pz * f.right[2]));
      y = Math.max(y, Math.abs(px * f.up[0] + py * f.up[1] + pz * f.up[2]));
    };
    for (let j = 0; j < points.length; j += 3) take(points[j], points[j + 1], points[j + 2]);
    for (const path of data.paths) for (const p of path.points) if (p) take(...p);
    return 0.45 * Math.min(w / x, h * 0.94 / y);
  }
  let fit = fitted(1000, 700);

  function render() {
    queued = false;
    const box = canvas.getBoundingClientRect(), ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.round(box.width * ratio), height = Math.round(box.height * ratio);
    if (width < 2 || height < 2) return;
    const over = dragging || width * height > 2.5e6 ? 1 : 2;  // antialiasing at rest
    const w = width * over, h = height * over;
    if (off.width !== w || off.height !== h || !image) {
      off.width = w;
      off.height = h;
      image = off.getContext('2d').createImageData(w, h);
      pixels = new Uint32Array(image.data.buffer);
      depth = new Float32Array(w * h);
    }
    pixels.fill(0);
    depth.fill(-Infinity);
    const f = frame(), scale = fit * Math.min(w / 1000, h / 700) * view.zoom;
    drawTriangles(f, w, h, scale);
    for (const path of data.paths) if (!hidden.has(path.key)) drawPath(f, path, w, h, scale, ratio * over);
    drawTool(f, w, h, scale);
    off.getContext('2d').putImageData(image, 0, 0);
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext('2d');
    context.imageSmoothingQuality = 'high';
    context.drawImage(off, 0, 0, width, height);
  }
  const draw = () => { if (!queued) { queued = true; requestAnimationFrame(render); } };

  let last = null;
  canvas.addEventListener('pointerdown', e => { last = e; dragging = true; canvas.setPointerCapture(e.pointerId); canvas.focus(); });
  canvas.addEventListener('pointermove', e => {
    if (!last) return;
    view.azimuth -= (e.clientX - last.clientX) * 0.009;
    view.elevation = Math.max(-1.57, Math.min(1.57, view.elevation + (e.clientY - last.clientY) * 0.009));
    last = e;
    draw();
  });
  const release = () => { last = null; dragging = false; draw(); };
  canvas.addEventListener('pointerup', release);
  canvas.addEventListener('pointercancel', release);
  canvas.addEventListener('dblclick', () => { Object.assign(view, first, {yUp: view.yUp}); draw(); });
  document.getElementById('upright').addEventListener('change', e => {
    Object.assign(view, first, {yUp: e.target.checked});
    fit = fitted(1000, 700);
    draw();
  });
  // The wheel scrolls the page unless the view has the focus.
  canvas.addEventListener('wheel', e => {
    if (document.activeElement !== canvas) return;
    e.preventDefault();
    view.zoom = Math.max(0.4, Math.min(12, view.zoom * Math.exp(-e.deltaY * 0.0012)));
    draw();
  }, {passive: false});
  canvas.addEventListener('keydown', e => {
    const turn = {ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1],
      '+': [0, 0, 1.2], '-': [0, 0, 1 / 1.2]}[e.key];
    if (!turn) return;
    e.preventDefault();
    view.azimuth += turn[0];
    view.elevation = Math.max(-1.57, Math.min(1.57, view.elevation + turn[1]));
    view.zoom = Math.max(0.4, Math.min(12, view.zoom * turn[2]));
    draw();
  });
  for (const box of document.querySelectorAll('input[data-path]')) {
    box.checked = !hidden.has(box.dataset.path);
    box.addEventListener('change', () => { hidden[box.checked ? 'delete' : 'add'](box.dataset.path); draw(); });
  }

  // One time cursor for all charts: vertical line, values in the legends, position of the tool in the 3D view.
  const charts = [...document.querySelectorAll('svg.chart')];
  function show(index) {
    cursor = Math.max(0, Math.min(data.series.device.length - 1, index));
    for (const chart of charts) {
      const line = chart.querySelector('.cursor'), left = +chart.dataset.left, right = +chart.dataset.right;
      const x = left + (right - left) * cursor / Math.max(1, data.series.device.length - 1);
      line.setAttribute('x1', x);
      line.setAttribute('x2', x);
      line.style.display = '';
      const values = data.series.charts[chart.dataset.chart];
      chart.parentElement.querySelectorAll('.value').forEach((node, k) => { node.textContent = values[k][cursor]; });
    }
    document.querySelectorAll('.now').forEach(node => { node.textContent = `at ${(cursor * data.series.step).toFixed(3)} s`; });
    draw();
  }
  for (const chart of charts) {
    chart.addEventListener('pointermove', e => {
      const box = chart.getBoundingClientRect(), left = +chart.dataset.left, right = +chart.dataset.right;
      const x = (e.clientX - box.left) * chart.viewBox.baseVal.width / box.width;
      show(Math.round((x - left) / (right - left) * (data.series.device.length - 1)));
    });
  }
  const size = new ResizeObserver(draw);
  size.observe(canvas);
  draw();
})();
