'use strict';
const kFirstPlots = ['output.force_N', 'output.penetration_m', 'output.position_m', 'output.guide_deviation_m', 'output.steps'];
const kEmptyScene = { mesh: { closed: false, wide: false, vertices: '', triangles: '' }, paths: [], toolRadius: 0.03, centre: [0, 0, 0], radius_m: 0.1 };
const kTrail = 400, kArrow = 0.6, kRecordLimit = 2000000;
const page = {
  session: null, store: null, plots: [], parameters: [], paused: false, frame: 0, style: {}, lamps: [], state: null,
  armed: false, flow: { at_ms: 0, records: 0, bytes: 0 }, draws: 0, seconds: 5, back: 0, newest: 0, recording: null, peak_N: 1,
  chains: [], far: 0, linkage: null,

  say(kind, what) {
    const banner = $('banner');
    if (banner.textContent !== what || banner.className !== kind) banner.className = kind, banner.textContent = what;
  },
  // Time: columns of the plots.
  columnOf(number) { return Math.floor(number / this.perColumn); },
  newestColumn() { return this.columnOf(this.newest); },
  lastColumn() { return this.columnOf(this.newest - this.back); },
  /** So many empty columns are nothing missing: a decimated stream over a short window. */
  mostBetween() { return Math.ceil(2 * this.session.decimation / this.perColumn) + 1; },
  setSeconds(seconds) {
    this.seconds = Math.max(0.02, Math.min(60, seconds));
    this.period_s = (this.session.about.period_us || 1000) * 1e-6;
    this.perColumn = Math.max(1e-3, this.seconds / this.period_s / kColumns);
    for (const plot of this.plots) plot.rebuild();
  },
  goBack(columns) {
    this.pause(true);
    const oldest = this.store.count ? this.store.u32[this.store.baseOf(this.store.first)] : 0;
    this.back = Math.max(0, Math.min(this.newest - oldest, this.back + columns * this.perColumn));
    for (const plot of this.plots) plot.rebuild();
  },
  pause(is) {
    this.paused = is;
    $('pause').textContent = is ? 'Go on' : 'Pause';
    $('pause').setAttribute('aria-pressed', String(is));
    if (is) return;
    this.back = 0;
    if (this.store?.count) this.newest = this.store.u32[this.store.baseOf(this.store.count - 1)];
    for (const plot of this.plots) plot.rebuild();
  },

  described(session) {
    this.store = new Store(session.recordBytes);
    this.state = null;
    this.back = this.newest = 0;
    this.flow = { at_ms: performance.now(), records: session.records, bytes: session.decoder.received };
    const about = session.about;
    $('board').textContent = `${about.board}, ${plain(1e3 / about.period_us)} kHz`;
    $('help').hidden = true;
    $('view').hidden = $('middle').hidden = $('right').hidden = false;
    $('decimation').value = String(session.decimation);
    $('plots').replaceChildren();
    this.plots = [];
    this.setSeconds(Number($('window').value));
    const names = session.fields.map(f => f.name), first = kFirstPlots.filter(n => names.includes(n));
    for (const name of first.length ? first : names.slice(1, 6)) this.plots.push(new Plot(name));
    this.buildLamps(session);
    this.buildParameters(session);
    $('link').replaceChildren();
    const rows = { board: about.board, 'servo period': `${about.period_us} \u00B5s`, 'asset CRC': '0x' + about.asset.toString(16).padStart(8, '0'),
      protocol: about.protocol, 'a record': `${session.recordBytes} bytes, ${session.fields.length} fields`, link: session.port.name,
      'load of the servo': '', 'dropped by the ring': '0', 'lost on the way': '0', 'damaged frames': '0' };
    for (const [name, value] of Object.entries(rows)) {
      const dd = make('dd', { textContent: value });
      dd.dataset.name = name;
      $('link').append(make('dt', { textContent: name }), dd);
    }
  },
  live(session) {
    this.say('good', `Connected to ${session.about.board}, receiving records.`);
    this.setConnected(true);
    this.pause(false);
  },
  ended(why) {
    this.setConnected(false);
    if (this.recording) this.stopRecording();
    this.say(why ? 'bad' : '', why ? `Disconnected: ${why}. The values shown are the last ones received; the controller keeps its own limits. Connect again when it is available.`
      : 'Disconnected.');
    this.armed = false;
  },
  held(port) {
    $('take').hidden = !port;
    if (!port) return;
    this.say('warn', 'Another page holds the link to the controller. This page waits; it shows nothing and sends nothing.');
    $('take').onclick = () => port.takeOver();
  },
  setConnected(is) {
    $('leave').hidden = !is;
    $('connect').hidden = $('serial').hidden = is;
    for (const e of document.querySelectorAll('#parameters input, #parameters button, #decimation, #clear, #panel button, #record')) e.disabled = !is;
    $('search').disabled = false;
    // The last received values stay, marked as such: the controller's present state is unknown.
    $('state').classList.toggle('past', !is);
    $('state').firstChild.textContent = is ? 'State' : 'State, as last reported';
    if (!is) $('flow').textContent = 'no records';
  },
  buildLamps(session) {
    this.lamps = [];
    this.faultBits = [];
    this.shownFaults = null;
    $('faults').replaceChildren();
    this.modeLamp = make('span', { className: 'lamp', id: 'mode', textContent: 'motors: ?' });
    $('lamps').replaceChildren(this.modeLamp);
    for (const bit of session.bits) {
      const field = session.field(bit.unit);
      if (!field) continue;
      if (bit.unit === 'output.faults') { this.faultBits.push({ bit, field }); continue; }
      if (/^(command|model) /.test(bit.name)) continue;
      const element = make('span', { className: 'lamp' + (/fault|stop/.test(bit.name) ? ' alarm' : ''), textContent: bit.name });
      $('lamps').append(element);
      this.lamps.push({ element, field, mask: 1 << bit.kind, seen: false });
    }
  },
  buildParameters(session) {
    this.parameters = session.parameters.map(row => new Parameter(session, row));
    const boxes = kGroups.map(([name], i) => {
      const box = make('details', { open: i < 2 }, make('summary', { textContent: name }));
      return box;
    });
    for (const parameter of this.parameters) boxes[kGroups.findIndex(([, test]) => test.test(parameter.row.name))].append(parameter.element);
    $('groups').replaceChildren(...boxes.filter(box => box.children.length > 1));
  },
  search(words) {
    const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
    for (const { element, row } of this.parameters)
      element.hidden = !wanted.every(word => `${row.name} ${row.text} ${row.unit}`.toLowerCase().includes(word));
    for (const box of $('groups').children) {
      box.hidden = wanted.length > 0 && ![...box.querySelectorAll('.parameter')].some(e => !e.hidden);
      if (wanted.length) box.open = true;
    }
  },
  // Presets: name and value of each parameter, as JSON.
  preset() { return JSON.stringify({ firmtouch_preset: 1, parameters: Object.fromEntries(this.parameters.map(p => [p.row.name, p.held])) }, null, 1) + '\n'; },
  async applyPreset(text) {
    let values;
    try { values = JSON.parse(text).parameters; } catch { values = null; }
    if (!values) return this.say('bad', 'This file is no preset of this page.');
    let taken = 0, refused = [];
    for (const parameter of this.parameters) {
      const value = values[parameter.row.name];
      if (value === undefined || Math.fround(value) === parameter.held) continue;
      if (await parameter.apply(Number(value))) ++taken;
      else refused.push(parameter.row.name);
    }
    this.say(refused.length ? 'warn' : 'good', `Preset: ${taken} changed` + (refused.length ? `; refused: ${refused.join(', ')} (press Disable to raise limits, then load it again)` : '.'));
  },
  // CSV of records: a name a column as in a log, and the names of the set bits.
  csv(words, count) {
    const fields = this.session.fields, store = Object.assign(new Store(4 * this.store.words), { u32: words, f32: new Float32Array(words.buffer), i32: new Int32Array(words.buffer) });
    const bits = fields.filter(f => f.unit === 'bits'), lines = [];
    lines.push([...fields.flatMap(f => f.count > 1 ? [...Array(f.count).keys()].map(k => `${f.name}[${k}]`) : [f.name]), ...bits.map(f => f.name + '_names')].join(','));
    for (let i = 0, base = 0; i < count; ++i, base += this.store.words) {
      const values = fields.flatMap(f => [...Array(f.count).keys()].map(k => { const v = store.value(f, base, k); return f.kind === 2 ? Number(v.toPrecision(9)) : v; }));
      const names = bits.map(f => this.session.bits.filter(b => b.unit === f.name && (words[base + f.offset / 4] >>> b.kind & 1)).map(b => b.name).join('|'));
      lines.push([...values, ...names].join(','));
    }
    return lines.join('\n') + '\n';
  },
  record(number, view) {
    const base = this.store.push(view);
    if (this.recording && this.recording.count < kRecordLimit) {
      this.recording.chunks.push(this.store.u32.slice(base, base + this.store.words));
      ++this.recording.count;
    }
    for (const lamp of this.lamps) if (this.store.u32[base + lamp.field.offset / 4] & lamp.mask) lamp.seen = true;
    this.state = base;
    if (this.armed && !this.isEnabled()) { this.armed = false; this.sendClear(); }
    if (this.paused) return;
    this.newest = number;
    const column = this.columnOf(number);
    for (const plot of this.plots) plot.add(column, base);
  },
  startRecording() { this.recording = { chunks: [], count: 0 }; },
  stopRecording() {
    const { chunks, count } = this.recording, words = new Uint32Array(count * this.store.words);
    this.recording = null;
    chunks.forEach((chunk, i) => words.set(chunk, i * this.store.words));
    const text = this.csv(words, count);
    save(`firmtouch ${new Date().toISOString().slice(0, 19).replace(/:/g, '-')}.csv`, 'text/csv', [text]);
    return text;
  },
  flag(name) {
    const lamp = this.lamps.find(l => l.element.textContent === name);
    return lamp && this.state !== null && (this.store.u32[this.state + lamp.field.offset / 4] & lamp.mask) !== 0;
  },
  isEnabled() { return this.flag('enable'); },
  async report(what, request) {
    try {
      const result = await request;
      if (result !== 0) this.say('warn', `${what}: ${kAckWords[result]}`);
    } catch (error) { this.say('warn', `${what}: ${error.message}`); }
  },
  sendClear() { return this.report('Faults not cleared', this.session.clearFaults()); },
  panel(flags) { return this.report('Not done', this.session.panel(flags)); },
  showState() {
    if (this.state === null || !this.session.live) return;
    const state = this.session.field('output.state');
    for (const lamp of this.lamps) {
      lamp.element.classList.toggle('on', lamp.seen || (this.store.u32[this.state + lamp.field.offset / 4] & lamp.mask) !== 0);
      lamp.seen = false;
    }
    const mode = state ? this.store.u32[this.state + state.offset / 4] & 255 : 0;
    this.modeLamp.textContent = 'motors: ' + (kModes[mode] || mode);
    this.modeLamp.className = 'lamp' + (mode === 4 ? ' alarm on' : mode === 2 ? ' on' : '');
    $('record').textContent = this.recording ? `Stop and save (${this.recording.count})` : 'Record';
    if (!this.faultBits.length) return;
    const faults = this.store.u32[this.state + this.faultBits[0].field.offset / 4];
    $('clear').disabled = faults === 0 || this.armed;
    $('clear').textContent = this.armed ? 'Open the enable switch or press Disable: faults are cleared then' : 'Clear faults';
    if (faults === 0) this.armed = false;
    if (faults === this.shownFaults) return;
    this.shownFaults = faults;
    const shown = this.faultBits.filter(f => faults & (1 << f.bit.kind));
    $('faults').replaceChildren(...shown.map(({ bit }) => make('li', {}, make('b', { textContent: bit.name }), make('span', { textContent: bit.text }))));
    if (!shown.length) $('faults').append(make('li', { className: 'none', textContent: 'No faults.' }));
  },
  showFlow(now_ms) {
    const s = this.session, f = this.flow, passed_s = (now_ms - f.at_ms) / 1000;
    if (passed_s < 0.5) return;
    $('flow').textContent = `${Math.round((s.records - f.records) / passed_s)} records/s \u00B7 ${((s.decoder.received - f.bytes) / passed_s / 1000).toFixed(0)} kB/s \u00B7 ${Math.round(this.draws / passed_s)} frames/s`;
    this.flow = { at_ms: now_ms, records: s.records, bytes: s.decoder.received };
    this.draws = 0;
    const put = (name, value) => { const e = $('link').querySelector(`[data-name="${name}"]`); if (e) e.textContent = value; };
    const work = s.field('input.last_work_us');
    if (work && this.state !== null) put('load of the servo', `${(100 * this.store.u32[this.state + work.offset / 4] / s.about.period_us).toFixed(0)} % of the period`);
    put('dropped by the ring', s.dropped);
    put('lost on the way', Math.max(0, s.missing - s.dropped));
    put('damaged frames', s.decoder.rejects + s.port.rejects);
    const silent = s.live && s.decimation > 0 && now_ms - s.lastAt_ms > 1000;
    if (silent) this.say('warn', `No record for ${((now_ms - s.lastAt_ms) / 1000).toFixed(0)} s: the controller sends nothing; check its cable.`);
    else if (this.wasSilent && s.live) this.say('good', `Connected to ${s.about.board}, receiving records again.`);
    this.wasSilent = silent;
  },
  // In the view's frame: that of the asset, which the controller's scene parameters move in the device's.
  normal(p) {
    const held = axis => this.parameters.find(one => one.row.name === `scene_${axis}_m`)?.held || 0;
    return p.map((v, k) => (v - held('xyz'[k]) - this.scene.centre[k]) / this.scene.radius_m);
  },
  // Base and elbow of each chain of a linkage, which ends at the tip; none where it cannot be.
  takeTip(tip_m) {
    if (!this.linkage) return;
    this.condition = this.linkage.reciprocalCondition(tip_m);
    this.chains = (this.linkage.at(tip_m)?.chains || []).flatMap(([base, elbow]) => [base, elbow, tip_m, null]);
    const points = this.chains.filter(Boolean).map(p => this.normal(p)), far = Math.max(0, ...points.map(p => Math.hypot(...p)));
    if (far <= 1.1 * this.far) return;
    this.far = far;
    this.stage.makeRoom(points);
  },
  showTool() {
    const { session, store } = this, position = session.field('output.position_m'), force = session.field('output.force_N');
    if (this.state === null || this.paused || !position || !force) return;
    const normal = p => this.normal(p), newton = store.vector(force, this.state);
    this.peak_N = Math.max(this.peak_N, Math.hypot(...newton));
    const each = Math.max(1, Math.floor(5000 / session.decimation / kTrail)), trail = [];
    for (let i = Math.max(store.first, store.count - each * kTrail); i < store.count; i += each) trail.push(normal(store.vector(position, store.baseOf(i))));
    this.stage.trail = trail;
    this.takeTip(store.vector(position, this.state));
    this.stage.setTool(normal(store.vector(position, this.state)), newton.map(v => v / this.peak_N * kArrow), [0, 0, 0], this.chains.map(p => p && normal(p)));
    const condition = this.condition > 0 ? (1 / this.condition).toFixed(2) : 'unknown';
    $('newton').textContent = (this.linkage ? `condition ${condition} \u00B7 ` : '') + `${Math.hypot(...newton).toFixed(2)} N`;
  },
  readStyle() {
    const css = getComputedStyle(document.documentElement), of = name => css.getPropertyValue(name).trim();
    this.style = { edge: of('--edge'), grid: of('--grid'), soft: of('--soft'), line: [0, 1, 2, 3].map(k => of('--c' + k)) };
  },
  draw(now_ms) {
    requestAnimationFrame(t => this.draw(t));
    if (!this.session?.field || !this.store) return;
    ++this.frame; ++this.draws;
    if (this.frame % 60 === 1) this.readStyle();
    if (this.session.open) this.showFlow(now_ms);
    for (const plot of this.plots) plot.draw(this.lastColumn());
    if (this.frame % 6 === 0) this.showState();
    if (this.frame % 2 === 0) this.showTool();
  },
  async connect(opener) {
    this.say('', 'Connecting\u2026');
    $('connect').disabled = $('serial').disabled = true;
    const session = this.session = new Session(this);
    try { await session.begin(opener); } catch (error) {
      if (session.port && session.open) { session.open = false; session.port.close(); }
      this.setConnected(false);
      this.say('bad', 'Not connected: ' + error.message);
    }
    $('connect').disabled = $('serial').disabled = false;
  },
};

page.scene = window.firmtouchScene || kEmptyScene;
if (page.scene.linkage) page.linkage = new Linkage(page.scene.linkage);
page.stage = new View3d($('stage'), page.scene);
$('connect').onclick = () => page.connect(openServer);
$('serial').onclick = () => {
  if (!navigator.serial) return page.say('bad', 'This browser has no WebSerial: use Chromium or Edge, or firmtouch-sim live DEVICE.');
  page.connect(openSerial);
};
$('leave').onclick = () => page.session.leave();
$('window').onchange = () => page.setSeconds(Number($('window').value));
$('decimation').onchange = () => page.session.stream(Number($('decimation').value)).catch(error => page.say('warn', error.message));
$('pause').onclick = () => page.pause(!page.paused);
$('clear').onclick = () => { if (page.isEnabled()) page.armed = true; else page.sendClear(); };
$('enable').onclick = () => page.panel(0);
$('disable').onclick = () => page.panel(kPanelDisable);
$('stop').onclick = () => page.panel(kPanelDisable | kPanelStop);
document.addEventListener('keydown', e => {
  if (e.key !== 'Escape' || !page.session?.live) return;
  e.preventDefault();
  $('stop').click();
});
$('search').oninput = () => page.search($('search').value);
$('save').onclick = () => save('preset.json', 'application/json', [page.preset()]);
$('load').onchange = async () => { const [file] = $('load').files; if (file) await page.applyPreset(await file.text()); $('load').value = ''; };
$('record').onclick = () => page.recording ? page.stopRecording() : page.startRecording();
$('upright').onchange = e => page.stage.reset(e.target.checked);
page.setConnected(false);
page.readStyle();
requestAnimationFrame(t => page.draw(t));
if (/^http/.test(location.protocol)) page.connect(openServer);
