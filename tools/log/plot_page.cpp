#include "log/plot_page.hpp"

#include "chart/chart.hpp"

namespace firmtouch::log {
namespace {

constexpr const char* kStyle =
    "body{margin:1.5rem auto;max-width:1160px;padding:0 1rem;background:#fff;color:#16202e;"
    "font-family:system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif}"
    "pre{background:#f4f6f9;padding:1rem;overflow-x:auto;border-radius:8px;font-size:13px}";

// The values are those of the drawing: each line's height where the pointer is.
constexpr const char* kScript = R"(
const root = document.querySelector('svg'), charts = [...root.querySelectorAll('svg.chart')];
const seconds = +root.dataset.seconds;
const lines = charts.map(chart => {
  const found = new Map();
  for (const line of chart.querySelectorAll('polyline')) {
    const points = line.getAttribute('points').split(' ').map(pair => pair.split(',').map(Number));
    const name = line.dataset.series;
    found.set(name, (found.get(name) || []).concat([points]));
  }
  return found;
});
function height(pieces, x) {
  for (const points of pieces) {
    if (x < points[0][0] - 0.5 || x > points[points.length - 1][0] + 0.5) continue;
    let near = points[0];
    for (const point of points) if (Math.abs(point[0] - x) < Math.abs(near[0] - x)) near = point;
    return near[1];
  }
  return NaN;
}
function value(chart, y) {
  const d = chart.dataset, share = (+d.base - y) / (d.base - d.top);
  return d.log ? d.high ** share : +d.low + share * (d.high - d.low);
}
root.addEventListener('pointermove', event => {
  const box = charts[0].getBoundingClientRect(), view = charts[0].viewBox.baseVal;
  const left = +charts[0].dataset.left, right = +charts[0].dataset.right;
  const x = Math.max(left, Math.min(right, (event.clientX - box.left) * view.width / box.width));
  root.querySelector('.now').textContent = 'at ' + (seconds * (x - left) / (right - left)).toFixed(3) + ' s';
  charts.forEach((chart, i) => {
    const line = chart.querySelector('.cursor');
    line.style.display = '';
    line.setAttribute('x1', x);
    line.setAttribute('x2', x);
    root.querySelectorAll('.value' + i).forEach((node, k) => {
      const found = value(chart, height(lines[i].get(String(k)) || [], x));
      node.textContent = Number.isFinite(found) ? Number(found.toPrecision(3)).toString() : '';
    });
  });
});
)";

}  // namespace

std::string page_of(const std::string& title, const std::string& svg, const std::string& text) {
  return "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
         chart::html_of(title) + "</title><style>" + kStyle + "</style></head><body>" + svg +
         "<pre>" + chart::html_of(text) + "</pre><script>" + kScript + "</script></body></html>\n";
}

}  // namespace firmtouch::log
