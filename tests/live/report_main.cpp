#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "live/page_test.hpp"

// A run's report in a browser: everything that a reader can do with it, done by a script.

namespace {

using firmtouch::live_test::PageTest;

struct Test : PageTest {
  using PageTest::PageTest;

  void run(const std::string& script) { browser.evaluate("(() => { " + script + " })()"); }
  // A mouse over the first chart, at these shares of its width.
  void drag_chart(double from, double to) {
    run("report.charts[0].node.scrollIntoView({ block: 'center' })");
    const std::string box = "report.charts[0].node.getBoundingClientRect()";
    const double left = number(box + ".left"), width = number(box + ".width"),
                 y = number(box + ".top + 60");
    const auto mouse = [&](const char* type, double share, const char* more) {
      browser.input("dispatchMouseEvent", "{\"type\":\"" + std::string(type) +
                                              "\",\"x\":" + std::to_string(left + share * width) +
                                              ",\"y\":" + std::to_string(y) + more + "}");
    };
    mouse("mouseMoved", from, "");
    mouse("mousePressed", from, ",\"button\":\"left\",\"buttons\":1,\"clickCount\":1");
    for (int i = 1; i <= 5; ++i)
      mouse("mouseMoved", from + (to - from) * i / 5, ",\"button\":\"left\",\"buttons\":1");
    mouse("mouseReleased", to, ",\"button\":\"left\",\"clickCount\":1");
  }
};

void time(Test& test) {
  test.run(
      "document.getElementById('slider').value = 5000; "
      "document.getElementById('slider').oninput()");
  test.check("the slider moves the time of all charts and of the tool",
             test.becomes("Math.abs(report.time.cursor - report.time.seconds / 2) < 0.01 && "
                          "document.getElementById('clock').textContent === "
                          "report.time.cursor.toFixed(3) + ' s'"));
  test.run("document.getElementById('speed').value = '4'; document.getElementById('play').click()");
  test.check("play moves it on", test.becomes("report.time.cursor > report.time.seconds * 0.6"));
  test.run("document.getElementById('play').click(); window.at = report.time.cursor");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  test.check("pause holds it", test.becomes("report.time.cursor === window.at", 1));
}

// Three ticks of 50 N in the middle of the force of the run.
void event(Test& test) {
  test.run(
      "report.charts[0].node.scrollIntoView({ block: 'center' }); "
      "const c = report.charts[0].about.curves[1]; for (const i of [6000, 6001, 6002]) c.low[i] "
      "= 50; report.charts[0].draw(); window.points = () => "
      "report.charts[0].node.querySelector('polyline[data-series=\"1\"]')"
      ".getAttribute('points').split(' ').map(p => p.split(',').map(Number))");
  test.check("3 ms in 12 s stand out in the whole chart",
             test.becomes("Math.min(...window.points().map(p => p[1])) < 30", 2));
  test.run("report.time.show(5.985, 0.03)");
  test.check("zoomed in, they are a tenth of the width, tick by tick",
             test.becomes("(() => { const high = window.points().filter(p => p[1] < 30); return "
                          "high.length === 3 && high[2][0] - high[0][0] > 50; })()",
                          2));
}

void zoom_and_pan(Test& test) {
  test.run("report.time.all()");
  test.run(
      "const n = report.charts[2].node; n.scrollIntoView(); n.focus(); const b = "
      "n.getBoundingClientRect(); n.dispatchEvent(new WheelEvent('wheel', { deltaY: -1000, "
      "clientX: b.left + b.width / 2, cancelable: true }))");
  test.check("the wheel zooms all charts at the pointer",
             test.becomes("report.time.span < 0.2 * report.time.seconds && "
                          "Math.abs((report.time.from + report.time.to) / 2 / report.time.seconds "
                          "- 0.5) < 0.1"));
  test.run("window.from = report.time.from");
  test.drag_chart(0.6, 0.4);
  test.check("a drag pans",
             test.becomes("report.time.from > window.from + 0.1 * report.time.span"));
  test.run("document.getElementById('all').click()");
  test.check("All shows everything", test.becomes("!report.time.isZoomed"));
  test.run("document.getElementById('in').click()");
  test.check("a button zooms", test.becomes("report.time.isZoomed"));
  test.run("report.time.all()");
}

void stage(Test& test) {
  test.run(
      "report.time.set(report.time.seconds * 0.6); const s = report.stage, c = s.canvas; "
      "c.scrollIntoView({ block: 'center' }); const b = c.getBoundingClientRect(); const p = "
      "(type, id, x, y) => c.dispatchEvent(new PointerEvent(type, { pointerId: id, "
      "pointerType: 'touch', clientX: b.left + x, clientY: b.top + y, buttons: 1 })); "
      "window.before = { ...s.view }; p('pointerdown', 1, 100, 100); p('pointerdown', 2, 200, "
      "100); p('pointermove', 1, 60, 110); p('pointermove', 2, 300, 140); p('pointerup', 1, "
      "60, 110); p('pointerup', 2, 300, 140)");
  test.check("two fingers zoom and move the 3D view",
             test.becomes("report.stage.view.zoom > 1.5 && Math.abs(report.stage.view.x) > 0.01"));
  test.run("report.stage.reset()");
  test.check("the force is an arrow",
             test.becomes("Math.hypot(...report.stage.force) > 0.1 && (() => { const c = "
                          "report.stage.canvas, d = c.getContext('2d').getImageData(0, 0, c.width, "
                          "c.height).data; let red = 0; for (let i = 0; i < d.length; i += 4) red "
                          "+= d[i] === 198 && d[i + 1] === 40 && d[i + 2] === 57; return red > 40; "
                          "})()"));
}

// The run has friction of 0.4 at rest, 0.25 sliding. The force is the record's; it begins with a
// press that does not slide.
void close_up(Test& test) {
  test.run(
      "window.closeUp = report.stage.closeUp; window.unit = a => a.map(v => v / Math.hypot(...a)); "
      "window.colours = () => { const c = closeUp.canvas, d = c.width ? c.getContext('2d')"
      ".getImageData(0, 0, c.width, c.height).data : [], all = new Set(); for (let i = 0; i < "
      "d.length; i += 4) all.add(`${d[i]},${d[i + 1]},${d[i + 2]}`); return all; }; "
      "window.said = () => document.querySelector('.close-up output').textContent; "
      "report.time.set(0.85)");
  test.check(
      "the close-up has the plane that a press is on, its normal along the force",
      test.becomes("closeUp.normals.length === 1 && unit(report.stage.force).every((v, k) "
                   "=> Math.abs(v - closeUp.normals[0][k]) < 0.02) && "
                   "/^The hand is 1.99 mm .* 0.00; friction 0.40, sliding 0.25/.test(said())"));
  test.check("it draws proxy, hand, plane and cone",
             test.becomes("['37,99,235', '126,138,160', '31,138,91', '226,116,43'].every(c => "
                          "colours().has(c))"));
  test.check("where the tool slides on a plane, the hand is on the cone of friction",
             test.becomes("(() => { const all = []; [...closeUp.held.kinds].forEach((kind, i) => { "
                          "closeUp.show(i); if (kind === '1') all.push(closeUp.along); }); const "
                          "count = is => all.filter(is).length; return all.length > 2000 && "
                          "count(a => Math.abs(a - 0.25) < 0.01) > 0.6 * all.length && "
                          "count(a => a < 0.41) > 0.99 * all.length; })()",
                          2));
  test.run("report.time.set(3)");
  test.check("without contact it draws nothing, and says so",
             test.becomes("said() === 'No contact.' && colours().size === 1"));
}

void lines_and_files(Test& test) {
  const std::string lines = "report.charts[0].node.querySelectorAll('polyline[data-series=\"0\"]')";
  test.check("a line is shown", test.becomes(lines + ".length > 0", 2));
  test.run("report.charts[0].section.querySelector('.keys button').click()");
  test.check("its legend hides it", test.becomes(lines + ".length === 0", 2));
  test.run("report.charts[0].section.querySelector('.keys button').click()");
  test.check("and shows it again", test.becomes(lines + ".length > 0", 2));
  test.check("a chart is saved as SVG that needs no style sheet",
             test.becomes("(() => { const t = report.charts[0].saveSvg(); return "
                          "t.startsWith('<svg') && t.includes('xmlns=') && t.includes('Force') && "
                          "!t.includes('var('); })()",
                          2));
  test.check("data are saved as CSV, a row a tick",
             test.becomes("(() => { const rows = report.charts[1].saveCsv().trim().split('\\n'); "
                          "return rows.length > 12000 && rows[0].startsWith('time_s,') && "
                          "rows[5000].split(',').length === 2; })()",
                          2));
}

// Of a run on an arm whose two links have 133 mm.
void links(Test& test) {
  test.check("the links of an arm end at the tool and are as long as its file says",
             test.becomes("(() => { const s = report.stage, d = (a, b) => report.radius_m * "
                          "Math.hypot(...[0, 1, 2].map(k => s.links[a][k] - s.links[b][k])); "
                          "return s.links.length === 4 && Math.abs(d(0, 1) - 0.133) < 1e-4 && "
                          "Math.abs(d(1, 2) - 0.133) < 1e-4 && s.links[2] === s.tool; })()",
                          30));
  test.run(
      "window.violet = () => { const c = report.stage.canvas, d = c.getContext('2d')"
      ".getImageData(0, 0, c.width, c.height).data; let n = 0; for (let i = 0; i < d.length; i += "
      "4) n += d[i] === 128 && d[i + 1] === 104 && d[i + 2] === 196; return n; }");
  test.check("they are drawn", test.becomes("window.violet() > 1000"));
  test.check("and follow the time within the picture",
             test.becomes("[...Array(21).keys()].every(i => { "
                          "report.time.set(report.time.seconds * i / 20); const s = report.stage; "
                          "return s.links.filter(Boolean).every(p => { const [x, y] = s.see(p); "
                          "return x > 0 && y > 0 && x < s.w && y < s.h; }); })",
                          2));
  test.picture("report_links");
  test.run("document.querySelector('input[data-path=links]').click()");
  test.check("their legend hides them", test.becomes("window.violet() === 0"));
  test.run(
      "window.map = Object.assign(new Image(), { src: document.querySelector('#condition image')"
      ".getAttribute('href') }); window.mapAt = (x, y) => { const c = document.createElement("
      "'canvas'), g = c.getContext('2d'); c.width = map.naturalWidth; c.height = "
      "map.naturalHeight; g.drawImage(map, 0, 0); return [...g.getImageData(x * c.width, y * "
      "c.height, 1, 1).data]; }; report.time.set(0.02)");
  test.check(
      "the map of the condition has the colour of the chart's figure where the tool is, "
      "and another out of reach",
      test.becomes(
          "map.naturalWidth > 50 && (() => { const s = document.querySelector('#condition "
          "svg').viewBox.baseVal, [x, y] = document.querySelector('#condition polyline')"
          ".getAttribute('points').split(' ')[0].split(',').map(Number), chart = "
          "report.charts.find(c => /^Reciprocal/.test(c.about.title)), is = "
          "Number(chart.values[0].textContent.trim()), [r, g, b] = mapAt(x / s.width, y / "
          "s.height); return Math.abs(r - (222 - 202 * is)) < 9 && Math.abs(g - (238 - 128 "
          "* is)) < 9 && Math.abs(b - (214 - 140 * is)) < 9 && String(mapAt(0, 0)) === "
          "'150,158,170,255'; })()"));
  test.check("the condition stands at its chart",
             test.becomes("(c => c && Number(c.values[0].textContent) > 0.1 && "
                          "Number(c.values[0].textContent) < 1)(report.charts.find(c => "
                          "/^Reciprocal condition/.test(c.about.title)))"));
}

}  // namespace

// report_page BROWSER URL URL_OF_A_LINKAGE FOLDER [PICTURES]
int main(int, char** words) {
  Test test(words);
  if (!test.check("the browser opens the report", test.browser.open(words[2], 1440, 1000)))
    return 1;
  test.check("it has its charts and its name",
             test.becomes("report.charts.length >= 6 && document.title.startsWith('part ')", 30));
  test.check("a card says how it feels, and the stop is said to be the scenario's",
             test.becomes("/Feel/.test(document.querySelector('.claims').textContent) && "
                          "/part of the scenario/.test(document.body.textContent)",
                          2));
  test.picture("report");
  time(test);
  zoom_and_pan(test);
  stage(test);
  close_up(test);
  test.picture("report_3d");
  lines_and_files(test);
  event(test);
  test.picture("report_zoomed");
  test.browser.resize(390, 844);
  test.check("at a phone's width nothing stands out to the side, and labels are readable",
             test.becomes("document.documentElement.scrollWidth <= 390 && "
                          "report.charts[0].node.querySelector('text').getBoundingClientRect()"
                          ".height >= 10"));
  const std::string codes = "[...document.querySelectorAll('.claims code')]";
  test.check(
      "no word of a command is broken",
      test.becomes(
          codes + ".length > 0 && " + codes + ".every(c => c.getClientRects().length === 1)", 2));
  test.picture("report_phone");
  if (test.check("the browser opens the report of a linkage",
                 test.browser.open(words[3], 1440, 1000)))
    links(test);
  return test.finish();
}
