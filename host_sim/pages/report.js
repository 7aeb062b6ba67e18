'use strict';
// The report: one time for charts, slider and 3D view.
const report = (() => {
  const $ = id => document.getElementById(id);
  const data = JSON.parse($('run-data').textContent), { samples } = data;
  const device = View3d.vectors(samples.device, 4), force = View3d.vectors(samples.force, 1);
  const turn = samples.turn ? View3d.vectors(samples.turn, 2 * Math.PI) : [];
  const stage = new View3d($('stage'), data, ['tool', 'hand']);
  // Joints of a linkage, a sample after the other: base and elbow of each chain, which ends at the tool.
  const joints = samples.joints ? View3d.vectors(samples.joints, 4) : [], each = joints.length / device.length;
  if (each) stage.makeRoom(joints);
  if ($('close_up')) stage.closeUp = new CloseUp($('close_up'), samples.held);
  const kArrow = 0.6;  // radii of the largest force
  const name = document.title.split(' - ')[0];
  let charts = [], queued = false, playing = null;

  const seconds = View3d.bytes(data.charts[0].curves[0].low).byteLength / 4 * data.bin_s;
  const time = new TimeWindow(seconds, 10 * data.bin_s, changed);
  function changed(isWindow) {
    const at = time.cursor / samples.step_s, i = Math.max(samples.first, Math.min(device.length - 1, Math.floor(at)));
    const next = Math.min(device.length - 1, i + 1), share = Math.max(0, Math.min(1, at - i));
    const between = (list, a, b) => list[a].map((v, k) => v + (list[b][k] - v) * share), tool = between(device, i, next), links = [];
    for (let k = 0; k < each; k += 2) links.push(between(joints, i * each + k, next * each + k), between(joints, i * each + k + 1, next * each + k + 1), tool, null);
    stage.closeUp?.show(i);
    stage.setTool(tool, force[i].map(v => v * kArrow), turn[i], links);
    const newton = Math.hypot(...force[i]) * samples.peak_N;
    $('clock').textContent = `${time.cursor.toFixed(3)} s`;
    document.querySelector('.stage .now').textContent = `at ${time.cursor.toFixed(3)} s, force ${newton.toFixed(2)} N`;
    $('slider').value = String(Math.round(10000 * time.cursor / time.seconds));
    if (!isWindow) return charts.forEach(chart => chart.showCursor());
    if (queued) return;
    queued = true;
    requestAnimationFrame(() => { queued = false; charts.forEach(chart => chart.draw()); });
  }
  function play(is) {
    cancelAnimationFrame(playing);
    playing = null;
    $('play').textContent = is ? '\u23F8' : '\u25B6';
    $('play').setAttribute('aria-label', is ? 'pause' : 'play');
    if (!is) return;
    if (time.cursor >= time.seconds - data.bin_s) time.set(0);
    let before = null;
    const step = now => {
      if (before !== null) time.set(time.cursor + (now - before) / 1000 * Number($('speed').value));
      before = now;
      if (time.cursor >= time.seconds) return play(false);
      playing = requestAnimationFrame(step);
    };
    playing = requestAnimationFrame(step);
  }

  const sections = [...document.querySelectorAll('#plots > section')];
  charts = data.charts.map((about, i) => new Chart(sections[i], about, data.bin_s, data.axis, time, name, i === 0));
  $('time').hidden = false;
  $('play').onclick = () => play(playing === null);
  $('slider').oninput = () => time.set(Number($('slider').value) / 10000 * time.seconds);
  $('in').onclick = () => time.zoom(0.5);
  $('out').onclick = () => time.zoom(2);
  $('earlier').onclick = () => time.pan(-time.span / 2);
  $('later').onclick = () => time.pan(time.span / 2);
  $('all').onclick = () => time.all();
  document.addEventListener('keydown', e => {
    if (e.key !== ' ' || /^(BUTTON|INPUT|SELECT|SUMMARY)$/.test(e.target.tagName)) return;
    e.preventDefault();
    play(playing === null);
  });
  stage.useLegend();
  new ResizeObserver(() => changed(true)).observe($('plots'));
  window.addEventListener('beforeprint', () => charts.forEach(chart => chart.draw()));
  time.cursor = data.start_s;
  charts.forEach(chart => chart.draw());
  changed(true);
  return { charts, time, stage, play, radius_m: data.radius_m };
})();
