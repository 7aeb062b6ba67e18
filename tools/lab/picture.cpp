#include "lab/picture.hpp"

#include <cmath>
#include <cstdio>

#include "bench/problem.hpp"
#include "surface/write_surface.hpp"

namespace firmtouch::lab {
namespace {

using tools::Point;

constexpr double kSize = 720;  // of a picture, pixels

}  // namespace

Picture::Picture(Point low, Point high, bool is_askew) : is_askew_(is_askew) {
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
  for (int k = 0; k < 8; ++k) {
    double x = 0, y = 0;
    seen({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z}, x, y);
    left = std::fmin(left, x), right = std::fmax(right, x);
    bottom = std::fmin(bottom, y), top = std::fmax(top, y);
  }
  scale_ = kSize / std::fmax(right - left, top - bottom);
  left_ = left, top_ = top;
  width_ = (right - left) * scale_, height_ = (top - bottom) * scale_;
}

void Picture::line(const std::vector<Point>& points, const char* style) {
  body_ +=
      "<polyline fill=\"none\" " + std::string(style) + " points=\"" + places(points) + "\"/>\n";
}

void Picture::area(const std::vector<Point>& points, const std::string& style) {
  body_ += "<polygon " + style + " points=\"" + places(points) + "\"/>\n";
}

void Picture::dot(Point p, double radius_px, const char* style) {
  double x = 0, y = 0;
  seen(p, x, y);
  char text[160];
  std::snprintf(text, sizeof(text), "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" %s/>\n",
                (x - left_) * scale_, (top_ - y) * scale_, radius_px, style);
  body_ += text;
}

void Picture::box(Point low, Point high, const char* style) {
  const double z[2] = {low.z, high.z};
  for (int k = 0; k < (high.z > low.z ? 2 : 1); ++k)
    line({{low.x, low.y, z[k]},
          {high.x, low.y, z[k]},
          {high.x, high.y, z[k]},
          {low.x, high.y, z[k]},
          {low.x, low.y, z[k]}},
         style);
  if (!(high.z > low.z)) return;
  for (const double x : {low.x, high.x})
    for (const double y : {low.y, high.y}) line({{x, y, low.z}, {x, y, high.z}}, style);
}

std::string Picture::svg() const {
  char head[240];
  std::snprintf(head, sizeof(head),
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-10 -10 %.0f %.0f\">\n"
                "<rect x=\"-10\" y=\"-10\" width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                width_ + 20, height_ + 20);
  return head + body_ + "</svg>\n";
}

double Picture::depth(Point p) const {
  return is_askew_ ? -0.435 * p.x - 0.757 * p.y + 0.499 * p.z : p.z;
}

void Picture::seen(Point p, double& x, double& y) const {
  x = is_askew_ ? 0.87 * p.x - 0.5 * p.y : p.x;
  y = is_askew_ ? 0.25 * p.x + 0.43 * p.y + 0.87 * p.z : p.y;
}

std::string Picture::places(const std::vector<Point>& points) const {
  std::string text;
  char number[40];
  for (const Point& p : points) {
    double x = 0, y = 0;
    seen(p, x, y);
    std::snprintf(number, sizeof(number), "%.1f,%.1f ", (x - left_) * scale_, (top_ - y) * scale_);
    text += number;
  }
  return text;
}

void draw_net(Picture& picture, const tools::SplineSurface& s, int lines) {
  constexpr int kAlong = 60;
  for (int i = 0; i <= lines; ++i) {
    std::vector<tools::Point> a, b;
    for (int j = 0; j <= kAlong; ++j) {
      const double p = static_cast<double>(i) / lines, q = static_cast<double>(j) / kAlong;
      a.push_back(point_at(s, s.u0 + p * (s.u1 - s.u0), s.v0 + q * (s.v1 - s.v0)));
      b.push_back(point_at(s, s.u0 + q * (s.u1 - s.u0), s.v0 + p * (s.v1 - s.v0)));
    }
    picture.line(a, kNet);
    picture.line(b, kNet);
  }
}

void write_picture(const Options& options, const std::string& name, const Picture& picture,
                   Report& report) {
  const std::string text = picture.svg();
  const std::string problem = tools::write_text(options.figures + "/" + name + ".svg", text);
  if (!problem.empty()) throw Problem(problem + ": give --figures a folder that exists");
  report.figure("drawn: " + name + ".svg", "", static_cast<double>(text.size()), "bytes");
}

}  // namespace firmtouch::lab
