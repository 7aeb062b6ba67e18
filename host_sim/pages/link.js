'use strict';
// The link: frames and messages as in firmware/firmtouch/link/frame.hpp and protocol.hpp.
const kProtocol = {{protocol}}, kMaxPayload = 244;  // the number is put in with the page
const kRemedies = {{remedies}};  // of rules; '0': of any other
const kHello = 1, kSetParam = 3, kBye = 4, kClearFaults = 5, kStream = 6, kDescribe = 7, kPanel = 9;
const kHelloReply = 0x81, kAck = 0x83, kLog = 0x84, kText = 0x85, kDescription = 0x86;
const kModeLive = 0, kModeIdentify = 0xFFFFFFFF, kCommandClearFaults = 0xFFFFFFFF;
const kNotReady = 64, kAssetRejected = 32;
const kAckWords = ['taken', 'the controller has no such parameter', 'out of range',
  'busy', 'rejected in lock-step', "the board's timer keeps its period"];
const kAckBusy = 3, kAckOfClearFaults = 0xFFFFFFFF, kAckOfStream = 0xFFFFFFFE, kAckOfPanel = 0xFFFFFFFC;
const kPanelDisable = 1, kPanelStop = 2;
const kModes = ['off', 'ramp in', 'on', 'ramp out', 'fault'];  // servo::Mode, the low byte of output.state
const kWhen = ['', 'only while the motors are off: press Disable first', 'while the motors are on it may only fall: press Disable, raise it, then Enable'];

const crcTable = new Uint32Array(256);
for (let i = 0; i < 256; ++i) {
  let c = i;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xEDB88320 ^ (c >>> 1) : c >>> 1;
  crcTable[i] = c;
}
function crc32(bytes, from, to) {
  let c = 0xFFFFFFFF;
  for (let i = from; i < to; ++i) c = crcTable[(c ^ bytes[i]) & 255] ^ (c >>> 8);
  return (c ^ 0xFFFFFFFF) >>> 0;
}
function encode(type, sequence, payload) {
  const frame = new Uint8Array(12 + payload.length), view = new DataView(frame.buffer);
  view.setUint16(0, 0x5AF7, true);
  view.setUint16(2, sequence, true);
  view.setUint16(4, payload.length, true);
  frame[6] = type;
  frame[7] = crc32(frame, 0, 7) & 255;
  frame.set(payload, 8);
  view.setUint32(8 + payload.length, crc32(frame, 0, 8 + payload.length), true);
  return frame;
}
function words(...values) {  // u32 each
  const bytes = new Uint8Array(4 * values.length), view = new DataView(bytes.buffer);
  values.forEach((v, i) => view.setUint32(4 * i, v, true));
  return bytes;
}
/** Finds whole frames in what comes, whatever stands between them. */
class Decoder {
  constructor(take) {
    this.take = take;  // (type, sequence, DataView of the payload), valid during the call
    this.bytes = new Uint8Array(1 << 17);
    this.view = new DataView(this.bytes.buffer);
    this.count = 0;
    this.rejects = 0;
    this.received = 0;
  }
  push(chunk) {
    this.received += chunk.length;
    for (let at = 0; at < chunk.length;) {
      const part = chunk.subarray(at, at + this.bytes.length - this.count);
      this.bytes.set(part, this.count);
      this.count += part.length;
      at += part.length;
      this.scan();
    }
  }
  scan() {
    const b = this.bytes, end = this.count;
    let at = 0;
    for (;;) {
      while (at < end && b[at] !== 0xF7) ++at;
      if (end - at < 8) break;
      const length = this.view.getUint16(at + 4, true);
      if (b[at + 1] !== 0x5A || (crc32(b, at, at + 7) & 255) !== b[at + 7] || length > kMaxPayload) {
        if (b[at + 1] === 0x5A) ++this.rejects;
        ++at;
        continue;
      }
      if (end - at < 12 + length) break;
      if (crc32(b, at, at + 8 + length) !== this.view.getUint32(at + 8 + length, true)) {
        ++this.rejects;
        ++at;
        continue;
      }
      this.take(b[at + 6], this.view.getUint16(at + 2, true), new DataView(b.buffer, at + 8, length));
      at += 12 + length;
    }
    b.copyWithin(0, at, end);
    this.count = end - at;
  }
}

// Two transports: a serial port, and the server of this page (firmtouch-sim live), which carries one frame a message.
// Both send and receive bytes and report once why they ended.
async function openServer(take, ended) {
  const address = location.origin.replace(/^http/, 'ws') + '/link', socket = new WebSocket(address);
  socket.binaryType = 'arraybuffer';
  await new Promise((done, failed) => {
    socket.onopen = done;
    socket.onerror = () => failed(new Error(`no link at ${address}; is firmtouch-sim live running, with a controller?`));
  });
  let why = 'firmtouch-sim live has ended', isMine = false;
  // The server says first whose the link is; this waits until it is this page's.
  const port = { name: 'firmtouch-sim live', decimation: 1, tries: kTries, rejects: 0, messages: 0,
    write: bytes => { if (socket.readyState === WebSocket.OPEN) socket.send(bytes); },
    takeOver: () => socket.send('take'), close: () => socket.close() };
  await new Promise((done, failed) => {
    socket.onmessage = event => {
      if (typeof event.data !== 'string') { ++port.messages; return take(new Uint8Array(event.data)); }
      const [word, rest] = [event.data.split(' ')[0], event.data.slice(event.data.indexOf(' ') + 1)];
      if (word === 'yours') { isMine = true; page.held(null); done(); }
      if (word === 'held' && isMine) { ended('another page took the link over'); socket.close(); } else if (word === 'held' && !isMine) page.held(port);
      if (word === 'rejects') port.rejects = Number(rest);
      if (word === 'closed') why = rest;
    };
    socket.onclose = () => { failed(new Error(why)); ended(why); };
    socket.onerror = () => {};
  });
  return port;
}

async function openSerial(take, ended) {
  const port = await navigator.serial.requestPort();
  await port.open({ baudRate: 1000000, bufferSize: 65536 });
  const reader = port.readable.getReader(), writer = port.writable.getWriter();
  (async () => {
    let why = 'the port was closed';
    try {
      for (;;) {
        const { value, done } = await reader.read();
        if (done) break;
        take(value);
      }
    } catch (error) { why = `the cable was pulled or the device reset (${error.message})`; }
    reader.releaseLock();
    writer.releaseLock();
    port.close().catch(() => {});
    ended(why);
  })();
  // 1 Mbaud carries some 690 records a second.
  return { name: 'serial port', decimation: 2, tries: kTries, rejects: 0, write: bytes => writer.write(bytes).catch(() => {}), close: () => reader.cancel() };
}

// A session with a controller: it describes itself, then sends records.
const kAnswer_ms = 1000, kTries = 5, kAssetTime_ms = 60000, kAtOnce = 4;
class NoAnswer extends Error {}
class Session {
  constructor(ui) {
    this.ui = ui;
    this.sequence = 0;
    this.waiting = new Set();  // {test, done}: pending replies
    this.fields = []; this.bits = []; this.parameters = [];
    this.dropped = 0; this.missing = 0; this.records = 0;
    this.last = null;  // number of the last record
    this.lastAt_ms = 0;
    this.open = false;
    this.decoder = new Decoder((type, sequence, view) => this.hear(type, sequence, view));
  }
  async begin(opener) {
    this.port = await opener(bytes => this.decoder.push(bytes), why => this.end(why));
    this.open = true;
    this.ui.say('', 'Connected. Reading the description from the controller…');
    const about = await this.hello(kModeIdentify, new Uint8Array(24), 0);
    if (about.protocol !== kProtocol) {
      throw new Error(`the controller speaks protocol ${about.protocol}, this page ${kProtocol}: take both from the same release`);
    }
    if (about.refused & kAssetRejected) {
      throw new Error(`the controller rejects its asset by rule R${about.rule} at element ${about.element}: ${kRemedies[about.rule] || kRemedies[0]}`);
    }
    this.about = about;
    this.fields = await this.describe(0, 'records');
    this.bits = await this.describe(1, 'lamps and faults');
    this.parameters = await this.describe(2, 'parameters');
    let offset = 0;
    for (const field of this.fields) { field.offset = offset; offset += 4 * field.count; }
    this.recordBytes = offset;
    this.field = name => this.fields.find(f => f.name === name);
    this.decimation = this.port.decimation;
    this.ui.described(this);
    const live = await this.hello(kModeLive, about.identity, this.decimation);
    if (live.refused) throw new Error(`the controller refuses (reasons ${live.refused})`);
    this.lastAt_ms = performance.now();
    this.live = true;
    this.ui.live(this);
  }
  end(why) {
    if (!this.open) return;
    this.open = this.live = false;
    for (const one of this.waiting) one.failed(new Error(why));
    this.waiting.clear();
    this.ui.ended(why);
  }
  leave() {
    if (!this.open) return;
    this.send(kBye, words(0));
    this.end('');
    setTimeout(() => this.port.close(), 50);
  }
  send(type, payload) {
    this.sequence = (this.sequence + 1) & 0xFFFF;
    this.port.write(encode(type, this.sequence, payload));
    return this.sequence;
  }
  /** Sends, and again where no answer comes: none of these does harm when it comes twice. Each time it waits twice as
   *  long: an answer may stand behind seconds of records. */
  async request(type, payload, is_it) {
    const tries = this.live ? kTries : this.port.tries;
    for (let i = 0; i < tries; ++i) {
      if (!this.open) throw new Error('the link is closed');
      const one = {};
      const answer = new Promise((done, failed) => { one.done = done; one.failed = failed; });
      one.sequence = this.send(type, payload);
      one.test = is_it;
      this.waiting.add(one);
      const late = setTimeout(() => { this.waiting.delete(one); one.done(null); }, kAnswer_ms << i);
      const found = await answer;
      clearTimeout(late);
      if (found !== null) return found;
      if (!this.live) this.ui.say('warn', `No answer for ${2 ** (i + 1) - 1} s; waiting until ${2 ** tries - 1} s are over. Is it powered, and is this the controller program?`);
    }
    throw new NoAnswer('no answer; is this the controller program, and the line at 1 Mbaud?');
  }
  async hello(mode, identity, decimation) {
    const payload = new Uint8Array(32);
    payload.set(identity);
    const view = new DataView(payload.buffer);
    view.setUint32(0, kProtocol, true);
    view.setUint32(24, mode, true);
    view.setUint32(28, decimation, true);
    const since_ms = performance.now();
    for (;;) {
      const reply = await this.request(kHello, payload, (type, v) => type === kHelloReply && v.byteLength >= 56 && {
        protocol: v.getUint32(0, true), asset: v.getUint32(4, true), identity: new Uint8Array(v.buffer.slice(v.byteOffset, v.byteOffset + 24)),
        refused: v.getUint32(24, true), rule: v.getUint32(28, true), element: v.getUint32(32, true),
        period_us: v.getUint32(36, true), board: text(v, 40, 16) });
      if (!(reply.refused & kNotReady) || performance.now() - since_ms > kAssetTime_ms) return reply;
      this.ui.say('', 'The controller is proving its asset…');
      await new Promise(done => setTimeout(done, 200));
    }
  }
  async row(what, index) {
    return this.request(kDescribe, words(what | (index << 16)), (type, v) => {
      if (type !== kDescription || v.byteLength < 80) return false;
      if (v.getUint16(0, true) !== what || v.getUint16(2, true) !== index) return false;
      return { index, rows: v.getUint16(4, true), kind: v.getUint8(6), count: v.getUint8(7),
        number: [0, 1, 2, 3].map(k => v.getFloat32(8 + 4 * k, true)),
        name: text(v, 24, 32), unit: text(v, 56, 24), text: v.byteLength >= 176 ? text(v, 80, 96) : '' };
    });
  }
  async describe(what, name) {
    const first = await this.row(what, 0), rows = [first];
    for (let i = 1; i < first.rows; i += kAtOnce) {
      this.ui.say('', `The controller describes its ${name}: ${i} of ${first.rows}`);
      const some = [];
      for (let k = i; k < Math.min(i + kAtOnce, first.rows); ++k) some.push(this.row(what, k));
      rows.push(...await Promise.all(some));
    }
    return first.rows ? rows : [];
  }
  hear(type, sequence, view) {
    if (type === kLog) return this.record(view);
    for (const one of this.waiting) {
      const answer = one.test(type, view, sequence === one.sequence);
      if (answer) { this.waiting.delete(one); one.done(answer); return; }
    }
    if (type === kText) this.ui.say('warn', 'The controller says: ' + text(view, 0, view.byteLength));
  }
  record(view) {
    if (view.byteLength !== 4 + this.recordBytes) return;  // from an earlier session, not yet described
    this.dropped = view.getUint32(0, true);
    const number = view.getUint32(4, true);
    if (this.last !== null && this.decimation > 0) {
      const jump = (number - this.last) >>> 0;
      if (jump > this.decimation && jump < 0x80000000) this.missing += Math.round(jump / this.decimation) - 1;
    }
    this.last = number;
    this.lastAt_ms = performance.now();
    ++this.records;
    this.ui.record(number, view);
  }
  async set(index, value) {
    const payload = words(index, 0);
    new DataView(payload.buffer).setFloat32(4, value, true);
    for (let i = 0; i < 20; ++i) {
      const result = await this.acknowledged(kSetParam, payload, index);
      if (result === kAckBusy) { await new Promise(done => setTimeout(done, 20)); continue; }
      if (result !== 0) return { taken: false, why: kAckWords[result] || `refused (${result})` };
      break;
    }
    // Accepted into the mailbox; the tick decides. The value that holds now is read back from the controller.
    let row;
    for (const since_ms = performance.now(); performance.now() - since_ms < 1500;) {  // a busy machine delays ticks
      row = await this.row(2, index);
      if (row.number[3] === Math.fround(value)) return { taken: true, value: row.number[3] };
      await new Promise(done => setTimeout(done, 20));
    }
    return { taken: false, value: row.number[3], why: row.kind ? `refused by the tick: ${kWhen[row.kind]}` : 'refused by the tick' };
  }
  async acknowledged(type, payload, index) {
    const answer = await this.request(type, payload, (kind, v, mine) => kind === kAck && mine && v.getUint32(0, true) === index && { result: v.getUint32(4, true) });
    return answer.result;
  }
  /** What the page holds: the motors off, or an emergency stop. */
  panel(flags) { return this.acknowledged(kPanel, words(flags), kAckOfPanel); }
  clearFaults() { return this.acknowledged(kClearFaults, words(0), kAckOfClearFaults); }
  async stream(decimation) {
    await this.acknowledged(kStream, words(decimation), kAckOfStream);
    this.decimation = decimation;
    this.last = null;
  }
}
function text(view, offset, length) {
  const bytes = new Uint8Array(view.buffer, view.byteOffset + offset, length);
  const end = bytes.indexOf(0);
  return new TextDecoder().decode(bytes.subarray(0, end < 0 ? length : end));
}

