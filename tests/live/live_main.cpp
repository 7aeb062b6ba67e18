#include <signal.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "live/page_test.hpp"

// The live page in a browser, against the controller program whose joints a simulated hand moves.
// The test uses the page's own buttons and inputs, and reads what it shows.

namespace {

using firmtouch::live_test::PageTest;

constexpr double kPatience_s = 40;
constexpr double kConnect_s = 60;
constexpr const char* kMotorsAreOn = "$('mode').textContent === 'motors: on'";

struct Test : PageTest {
  using PageTest::PageTest;

  bool check(const char* claim, bool holds) {
    PageTest::check(claim, holds);
    if (!holds)
      std::printf("      the page says: %s\n", browser.evaluate("$('banner').textContent").c_str());
    return holds;
  }
  // Types a value into a parameter's field, as a person does.
  void type(const std::string& parameter, const std::string& value) {
    const std::string input =
        "document.querySelector('[data-parameter=" + parameter + "] input[type=number]')";
    browser.evaluate(input + ".value = '" + value + "', " + input +
                     ".dispatchEvent(new Event('change'))");
  }
  bool said(const std::string& parameter, const std::string& what) {
    return becomes("document.querySelector('[data-parameter=" + parameter +
                       "] .said').textContent.includes('" + what + "')",
                   kPatience_s);
  }
  std::string said_of(const std::string& parameter) {
    return browser.evaluate("document.querySelector('[data-parameter=" + parameter +
                            "] .said').textContent");
  }
  // Greatest of a field's length over the next `ticks` records.
  double peak(const char* field, int ticks) {
    const std::string begin = browser.evaluate("page.newest");
    becomes("page.newest - " + begin + " > " + std::to_string(ticks), 20);
    return number(
        std::string("(() => { const f = page.session.field('") + field +
        "'), s = page.store; let most = 0; for (let i = Math.max(0, s.count - " +
        std::to_string(ticks) +
        " / page.session.decimation); i < s.count; ++i) { const b = s.baseOf(i); let q = 0; for "
        "(let k = 0; k < f.count; ++k) q += s.value(f, b, k) ** 2; most = "
        "Math.max(most, Math.sqrt(q)); } return most; })()");
  }
};

// What records at 10 kHz cost the page, whatever brings them: frames as the controller sends them,
// in pieces of 4 KB, to its decoder, its store and its plots.
constexpr const char* kCostOf10kHz =
    "(() => { const n = 10000, parts = []; for (let i = 0; i < n; ++i) { const p = new "
    "Uint8Array(4 + page.session.recordBytes); new DataView(p.buffer).setUint32(4, i, true); "
    "parts.push(...encode(kLog, i & 0xFFFF, p)); } const bytes = new Uint8Array(parts); let "
    "records = 0; const decoder = new Decoder((t, q, v) => { ++records; page.record(v.getUint32(4, "
    "true), v); }); const begin = performance.now(); for (let at = 0; at < bytes.length; at += "
    "4096) decoder.push(bytes.subarray(at, at + 4096)); for (const plot of page.plots) "
    "plot.draw(page.columnOf(n)); return records + ' records of ' + page.session.recordBytes + ' "
    "bytes: ' + Math.round(performance.now() - begin) + ' ms to read and plot'; })()";

constexpr const char* kConnected = "$('banner').textContent.includes('receiving records')";
constexpr const char* kNoFault = "$('faults').textContent.includes('No faults')";
constexpr int kPressTicks = 2100;  // a press and a lift of the hand's

void stiffness(Test& test) {
  const double before_N = test.peak("output.force_N", kPressTicks);
  test.type("contact_stiffness_N_per_m", "0");
  test.type("guide_stiffness_N_per_m", "0");
  test.check("a stiffness is changed, acknowledged, and shown as the controller has it",
             test.said("contact_stiffness_N_per_m", "acknowledged: 800 ") &&
                 test.said("guide_stiffness_N_per_m", "acknowledged: 400 "));
  test.type("guide_damping_N_s_per_m", "0");
  test.said("guide_damping_N_s_per_m", "acknowledged");
  test.becomes("page.newest % 50 === 0", 1);
  // A stiffness acts in full when contact is next made: the hand may be pressing now.
  test.peak("output.force_N", kPressTicks);
  const double soft_N = test.peak("output.force_N", kPressTicks);
  test.type("contact_stiffness_N_per_m", "1600");
  test.said("contact_stiffness_N_per_m", "acknowledged: 0 ");
  const double after_N = test.peak("output.force_N", 2 * kPressTicks);
  std::printf("      force, greatest: %.3f N; at 0 N/m %.3f N; at 1,600 N/m %.3f N\n", before_N,
              soft_N, after_N);
  test.check("the force follows it: there, gone, and back",
             before_N > 0.3 && soft_N < 0.02 && after_N > 0.3);
}

void refusals(Test& test) {
  test.type("contact_stiffness_N_per_m", "1e9");
  test.check("a value out of range is not sent, and the range is shown",
             test.said("contact_stiffness_N_per_m", "0 to 20000 N/m"));
  test.check("the controller refuses it by itself",
             test.becomes("page.session.set(1, 1e9).then(r => r.why.includes('out of range'))",
                          kPatience_s));
  test.becomes(kMotorsAreOn, kPatience_s);
  test.type("force_limit_N", "9");
  if (!test.check("a limit may only fall while the motors are on: refused by the tick, and said",
                  test.said("force_limit_N", "may only fall"))) {
    std::printf("      of the limit: %s\n", test.said_of("force_limit_N").c_str());
  }
}

void faults(Test& test) {
  test.type("max_speed_mps", "0.01");
  test.check("a fault is shown in words, with what governs it",
             test.becomes("/encoder.*max_speed_mps/.test($('faults').textContent)", kPatience_s));
  test.type("max_speed_mps", "5");
  test.said("max_speed_mps", "acknowledged");
  test.browser.evaluate("$('clear').click()");
  test.check("cleared when the operator opens the enable switch",
             test.becomes(kNoFault, kPatience_s));
}

// Buttons and a key switch the motors off and on; the enable switch keeps the last word.
void panel(Test& test) {
  test.becomes(kMotorsAreOn, kPatience_s);
  test.browser.evaluate("$('disable').click()");
  test.check("Disable switches the motors off",
             test.becomes("$('mode').textContent === 'motors: off'", kPatience_s));
  test.type("force_limit_N", "9");
  test.check("then a limit may rise", test.said("force_limit_N", "9 N"));
  test.browser.evaluate("$('enable').click()");
  test.check("Enable gives them back to the switch", test.becomes(kMotorsAreOn, kPatience_s));
  test.browser.evaluate(
      "document.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }))");
  test.check("Escape is an emergency stop: a latched fault",
             test.becomes("$('faults').textContent.includes('emergency stop')", kPatience_s) &&
                 test.becomes("page.isEnabled() === false", kPatience_s));
  test.browser.evaluate("$('clear').click()");
  test.check("it is cleared while the page holds the motors off",
             test.becomes(kNoFault, kPatience_s));
  test.browser.evaluate("$('enable').click()");
  test.check("and the motors come on again", test.becomes(kMotorsAreOn, kPatience_s));
}

void parameters(Test& test) {
  const std::string ends = "document.querySelector('[data-parameter=guide_ends]')";
  test.check("parameters stand in groups", test.becomes("$('groups').children.length >= 4", 1));
  test.browser.evaluate("$('search').value = 'guide ends', $('search').oninput()");
  test.check("search shows what it finds, and nothing else",
             test.becomes("!" + ends +
                              ".hidden && page.parameters.filter(p => "
                              "!p.element.hidden).length < 4",
                          1));
  test.browser.evaluate(ends + ".querySelector('button[data-value=\"2\"]').click()");
  test.check("a switch of three values has three buttons",
             test.becomes(ends + ".querySelectorAll('button').length === 3", 1) &&
                 test.becomes(ends + ".querySelector('[aria-pressed=true]').dataset.value === '2'",
                              kPatience_s));
  test.browser.evaluate(
      "window.kept = page.preset(), $('search').value = '', $('search').oninput()");
  test.type("contact_stiffness_N_per_m", "500");
  test.said("contact_stiffness_N_per_m", "acknowledged");
  test.browser.evaluate(
      "window.done = false, page.applyPreset(window.kept).then(() => window.done "
      "= true)");
  test.check("a preset brings back what was saved",
             test.becomes("window.done", kPatience_s) &&
                 test.becomes("JSON.stringify(page.preset()) === JSON.stringify(window.kept)", 1));
}

void recording(Test& test) {
  test.browser.evaluate("$('record').click()");
  test.becomes("page.recording.count > 100", kPatience_s);
  const std::string rows = "(window.saved || (window.saved = page.stopRecording())).split('\\n')";
  test.check("a recording is saved with a row a record and the names of the bits",
             test.becomes(rows + ".length > 101", 5) &&
                 test.becomes(rows + "[0].startsWith('number,') && " + rows +
                                  "[0].includes('output.force_N[2]') && " + rows +
                                  "[50].includes('enable')",
                              1));
}

void plots(Test& test) {
  test.browser.evaluate(
      "(() => { const c = page.plots[0].canvas, b = c.getBoundingClientRect(); page.pause(true); "
      "c.dispatchEvent(new PointerEvent('pointermove', { clientX: b.left + b.width / 2, clientY: "
      "b.top + 20 })); })()");
  test.check("pointing at a plot shows the values there",
             test.becomes("page.plots[0].hover > 50", 2));
  test.browser.evaluate(
      "(() => { const c = page.plots[0].canvas; c.focus(); c.dispatchEvent(new WheelEvent('wheel', "
      "{ deltaY: -700, cancelable: true })); })()");
  test.check("the wheel zooms", test.becomes("page.seconds < 2", 2));
  test.browser.evaluate("page.goBack(300)");
  test.check("a drag goes back in time", test.becomes("page.back > 0 && page.paused", 2));
  test.browser.evaluate("page.pause(false), page.setSeconds(5)");
  test.check("part, tool and force are shown in 3D",
             test.becomes("page.stage.corners.length > 1000 && page.stage.tool.every(v => "
                          "Math.abs(v) < 3) && page.stage.trail.length > 100",
                          kPatience_s));
  test.check("one message a frame: no more messages than frames",
             test.becomes("page.session.port.messages >= page.session.records && "
                          "page.session.port.messages < page.session.records * 1.5 + 500",
                          2));
}

// Of three chains at 120 degrees: links and rods as long as they are, a knee that is in its range,
// and no tip on the other side. Straight above the middle all directions are closed forms.
constexpr const char* kDelta =
    "(() => { const chain = turn => ({ base: [0.03 * Math.cos(turn), 0.03 * Math.sin(turn), 0], "
    "out: [Math.cos(turn), Math.sin(turn), 0], up: [0, 0, 1], link: 0.06, rod: 0.1, range: [-1, "
    "1.5] }); const of = { chains: [0, 1, 2].map(k => chain(k * 2 * Math.PI / 3)), turntable: "
    "null, second: null, isRelative: false, side: 1 }, tip = [0.01, -0.02, 0.08], d = (a, b) => "
    "Math.hypot(...a.map((v, k) => v - b[k])), delta = new Linkage(of), at = delta.at(tip); if "
    "(at.angles.length !== 3 || at.angles.some(v => v < -1 || v > 1.5)) return 'angles'; if "
    "(at.chains.some(([base, elbow]) => Math.abs(d(base, elbow) - 0.06) > 1e-12 || "
    "Math.abs(d(elbow, tip) - 0.1) > 1e-12)) return 'lengths'; if (new Linkage({ ...of, side: -1 "
    "}).at(tip) || delta.at([0, 0, 0.2])) return 'a tip that cannot be'; const [, [x, , z]] = "
    "delta.at([0, 0, 0.08]).chains[0], turn = delta.at([0, 0, 0.08]).angles[0], along = -x / 0.1, "
    "up = (0.08 - z) / 0.1, lift = (up * Math.cos(turn) - along * Math.sin(turn)), s = along / "
    "Math.SQRT2 / lift, t = up / lift, want = 3 / Math.sqrt((2 / s ** 2 + 1 / t ** 2) * (2 * s ** "
    "2 + t ** 2)); return Math.abs(delta.reciprocalCondition([0, 0, 0.08]) - want) < 1e-6 ? "
    "'right' : 'condition'; })()";

// The links of an arm of 133 mm each, whose tip is where the test says.
void links(Test& test) {
  test.browser.evaluate(
      "(() => { const take = page.takeTip.bind(page); page.takeTip = () => take(window.tip); "
      "window.tip = [0.15, 0.02, 0.03]; })()");
  test.check("links of a linkage are drawn, as long as they are",
             test.becomes("(() => { const s = page.stage, d = (a, b) => page.scene.radius_m * "
                          "Math.hypot(...[0, 1, 2].map(k => s.links[a][k] - s.links[b][k])); "
                          "return s.links.length === 4 && Math.abs(d(0, 1) - 0.133) < 1e-6 && "
                          "Math.abs(d(1, 2) - 0.133) < 1e-6; })()",
                          kPatience_s));
  test.check("with the condition number of its pose",
             test.becomes("(c => c > 1 && c < 10 && $('newton').textContent.startsWith(`condition "
                          "${c.toFixed(2)} \u00B7 `))(1 / page.condition)",
                          kPatience_s));
  test.browser.evaluate(
      "window.before = page.stage.links[0], page.parameters.find(p => p.row.name === "
      "'scene_x_m').held = 0.01");
  test.check("in the frame of the asset, which the scene's place moves",
             test.becomes("Math.abs((window.before[0] - page.stage.links[0][0]) * "
                          "page.scene.radius_m - 0.01) < 1e-9",
                          kPatience_s));
  test.picture("links");
  test.browser.evaluate(
      "page.parameters.find(p => p.row.name === 'scene_x_m').held = 0, window.tip = [2, 0, 0]");
  const std::string delta = test.browser.evaluate(kDelta);
  test.check(("and of a delta: " + delta).c_str(), delta.find("right") != std::string::npos);
  test.check("where its tip cannot be, none, and no condition",
             test.becomes("page.stage.links.length === 0 && "
                          "$('newton').textContent.startsWith('condition unknown')",
                          kPatience_s));
}

// A second page waits, takes the link over, and gives it back.
void second_page(Test& test, const std::string& url) {
  const std::string first = test.browser.page();
  test.browser.open(url, 1440, 960);
  test.check("a second page says that another one holds the link",
             test.becomes("$('banner').textContent.includes('Another page holds')", kPatience_s) &&
                 test.becomes("!page.session.live && !$('take').hidden", 1));
  test.browser.evaluate("$('take').click()");
  test.check("it can take the link over", test.becomes(kConnected, kConnect_s));
  test.browser.use(first);
  test.check("the first page reports it",
             test.becomes("$('banner').textContent.includes('another page took')", kPatience_s));
  test.browser.evaluate("$('connect').click()");
  test.check("it connects, waits, and takes the link back",
             test.becomes("$('banner').textContent.includes('Another page holds')", kPatience_s) &&
                 test.becomes("($('take').click(), true)", 1) &&
                 test.becomes(kConnected, kConnect_s));
}

// A cable that is none: a serial port for the page, whose bytes take the server's link.
constexpr const char* kStandInPort =
    "Object.defineProperty(navigator, 'serial', { configurable: true, value: { requestPort: async "
    "() => { let socket; const port = { async open(how) { window.baud = how.baudRate; socket = new "
    "WebSocket(location.origin.replace('http', 'ws') + '/link'); socket.binaryType = "
    "'arraybuffer'; await new Promise(done => socket.onopen = done); port.readable = new "
    "ReadableStream({ start(to) { socket.onmessage = event => { if (typeof event.data !== "
    "'string') to.enqueue(new Uint8Array(event.data)); }; window.pullCable = () => { to.error(new "
    "Error('The device has been lost.')); socket.close(); }; } }); port.writable = new "
    "WritableStream({ write(bytes) { socket.send(bytes); } }); }, async close() { socket.close(); "
    "} "
    "}; return port; } } })";

void serial(Test& test) {
  test.browser.evaluate("$('leave').click()");
  test.check("on request it leaves: what is shown is called the last that was reported",
             test.becomes("$('banner').textContent === 'Disconnected.'", 5) &&
                 test.becomes("$('state').textContent.startsWith('State, as last reported')", 1) &&
                 test.becomes("$('flow').textContent === 'no records'", 1));
  test.browser.evaluate(kStandInPort);
  test.browser.evaluate("$('serial').click()");
  test.check("it connects over a serial port too (a stand-in), at 1 Mbaud",
             test.becomes(kConnected, kConnect_s) && test.becomes("window.baud === 1000000", 1) &&
                 test.becomes("page.session.records > 5", kPatience_s));
  test.browser.evaluate("window.tip = [0.15, 0.02, 0.03]");
  test.check("there, too, the links of a linkage are drawn",
             test.becomes("page.stage.links.length === 4", kPatience_s));
  test.browser.evaluate("window.pullCable()");
  test.check("the cable is pulled: it says so",
             test.becomes("$('banner').textContent.includes('the cable was pulled')", 5));
  test.browser.evaluate("$('connect').click()");
  test.check("it connects again",
             test.becomes(kConnected, kConnect_s) &&
                 test.becomes("$('mode').textContent !== 'motors: ?'", kPatience_s));
}

}  // namespace

// live_page BROWSER URL CONTROLLER_PID FOLDER [PICTURES]
int main(int, char** words) {
  Test test(words);
  if (!test.check("the browser opens the page", test.browser.open(words[2], 1600, 1000))) return 1;
  if (test.check("it connects to the controller", test.becomes(kConnected, kConnect_s))) {
    const double first = test.number("page.session.records");
    test.check("records come, and the pictures move",
               test.becomes("page.session.records > 50 + " + std::to_string(first), kPatience_s) &&
                   test.becomes("document.querySelectorAll('.plot').length === 5", 1));
    test.check("the motors come on when the hand closes its switch",
               test.becomes(kMotorsAreOn, kPatience_s));
    test.check("the page has the remedies of rules that reject an asset",
               test.becomes("kRemedies[915].includes('part `linkage`') && "
                            "kRemedies[0].includes('bake it again')",
                            1));
    stiffness(test);
    test.picture("desktop");
    refusals(test);
    faults(test);
    panel(test);
    parameters(test);
    recording(test);
    plots(test);
    test.picture("tuned");
    links(test);
    second_page(test, words[2]);
    std::printf("      %s\n", test.browser.evaluate("$('flow').textContent").c_str());
    serial(test);
    test.check("no frame was damaged",
               test.browser.evaluate("page.session.decoder.rejects") == "0");
  }
  const pid_t controller = static_cast<pid_t>(std::atoi(words[3]));
  ::kill(controller, SIGSTOP);
  test.browser.evaluate("$('leave').click(), setTimeout(() => $('connect').click(), 200)");
  test.check("a controller that does not answer is reported within 3 s, with how long it may take",
             test.becomes("/No answer for [13] s; waiting until 31 s are over/.test("
                          "$('banner').textContent)",
                          3));
  ::kill(controller, SIGCONT);
  test.check("and when it answers, the page is connected", test.becomes(kConnected, kConnect_s));
  ::kill(controller, SIGKILL);
  test.check("the page reports a closed link",
             test.becomes("$('banner').textContent.includes('Disconnected')", 5) &&
                 test.becomes("$('state').textContent.startsWith('State, as last reported')", 1));
  test.picture("gone");
  std::printf("      a second at 10 kHz, %s\n", test.browser.evaluate(kCostOf10kHz).c_str());
  test.browser.resize(390, 844);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  test.check("at a phone's width nothing stands out to the side",
             test.becomes("document.documentElement.scrollWidth <= 390", 2));
  test.picture("phone");
  return test.finish();
}
