#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/report/scene3d.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kAzimuth_rad = 0.72, kElevation_rad = 0.52;  // the viewer's initial view
constexpr double kMargin = 0.93;  // share of the image that the scene fills
// Cosine between face and vertex normal above which a corner is shaded smoothly.
constexpr double kSmoothBelow = 0.82;

constexpr double kJointSize = 1.8;  // of a link's width

struct Screen {
  double x, y, depth;  // pixels; depth grows towards the eye
};

struct Canvas {
  Image image;
  std::vector<float> depth;
  Vec right, up, eye;
  Vec centre;
  double pixels_per_m;

  Screen see(Vec p) const {
    const Vec d = p - centre;
    return {image.width / 2.0 + dot(d, right) * pixels_per_m,
            image.height / 2.0 - dot(d, up) * pixels_per_m, dot(d, eye) * pixels_per_m};
  }
  void put(int x, int y, double z, Colour c) {
    if (x < 0 || y < 0 || x >= static_cast<int>(image.width) || y >= static_cast<int>(image.height))
      return;
    const size_t i = static_cast<size_t>(y) * image.width + static_cast<size_t>(x);
    if (z < static_cast<double>(depth[i])) return;
    depth[i] = static_cast<float>(z);
    image.pixels[i] = c;
  }
};

uint8_t channel(double value) {
  return static_cast<uint8_t>(std::clamp(std::lround(value), 0l, 255l));
}

// Two lights fixed to the camera and a soft rim, so that every face is readable.
Colour lit(const Canvas& canvas, Vec normal, Colour base) {
  const Vec key = unit(canvas.eye * 0.62 + canvas.up * 0.62 - canvas.right * 0.48);
  const Vec fill = unit(canvas.eye * 0.5 - canvas.up * 0.3 + canvas.right * 0.8);
  const double facing = std::max(0.0, dot(normal, canvas.eye));
  const double light = 0.34 + 0.62 * std::max(0.0, dot(normal, key)) +
                       0.16 * std::max(0.0, dot(normal, fill)) - 0.12 * std::pow(1 - facing, 3);
  const double shine = 46 * std::pow(std::max(0.0, dot(normal, unit(key + canvas.eye))), 40);
  return {channel(base.r * light + shine), channel(base.g * light + shine),
          channel(base.b * light + shine)};
}

std::vector<Vec> vertex_normals(const Scene3d& scene3d) {
  std::vector<Vec> normals(scene3d.vertices.size());
  for (const auto& t : scene3d.triangles) {
    const Vec n = cross(scene3d.vertices[t[1]] - scene3d.vertices[t[0]],
                        scene3d.vertices[t[2]] - scene3d.vertices[t[0]]);
    for (const uint32_t corner : t) normals[corner] = normals[corner] + n;
  }
  for (Vec& n : normals) n = unit(n);
  return normals;
}

void fill_triangle(Canvas& canvas, const Screen (&p)[3], const Vec (&normal)[3], Colour part) {
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  if (!(std::fabs(area) > 1e-12)) return;
  const auto low = [](double a, double b, double c) {
    return static_cast<int>(std::ceil(std::min({a, b, c}) - 0.5));
  };
  const auto high = [](double a, double b, double c) {
    return static_cast<int>(std::floor(std::max({a, b, c}) - 0.5));
  };
  const int x0 = std::max(0, low(p[0].x, p[1].x, p[2].x)),
            y0 = std::max(0, low(p[0].y, p[1].y, p[2].y));
  const int x1 = std::min(static_cast<int>(canvas.image.width) - 1, high(p[0].x, p[1].x, p[2].x));
  const int y1 = std::min(static_cast<int>(canvas.image.height) - 1, high(p[0].y, p[1].y, p[2].y));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double b =
          ((px - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (py - p[0].y)) / area;
      const double c =
          ((p[1].x - p[0].x) * (py - p[0].y) - (px - p[0].x) * (p[1].y - p[0].y)) / area;
      const double a = 1 - b - c;
      if (a < 0 || b < 0 || c < 0) continue;
      const double z = a * p[0].depth + b * p[1].depth + c * p[2].depth;
      canvas.put(x, y, z, lit(canvas, unit(normal[0] * a + normal[1] * b + normal[2] * c), part));
    }
}

void draw_mesh(Canvas& canvas, const Scene3d& scene3d) {
  const std::vector<Vec> normals = vertex_normals(scene3d);
  for (uint32_t i = 0; i < scene3d.triangles.size(); ++i) {
    const auto& t = scene3d.triangles[i];
    const Vec face = unit(cross(scene3d.vertices[t[1]] - scene3d.vertices[t[0]],
                                scene3d.vertices[t[2]] - scene3d.vertices[t[0]]));
    const double side = dot(face, canvas.eye) < 0 ? -1 : 1;  // an open surface shows its back too
    Screen p[3];
    Vec n[3];
    for (size_t k = 0; k < 3; ++k) {
      p[k] = canvas.see(scene3d.vertices[t[k]]);
      n[k] = (dot(face, normals[t[k]]) > kSmoothBelow ? normals[t[k]] : face) * side;
    }
    fill_triangle(canvas, p, n, part_colour(scene3d, i));
  }
}

// A line is a row of discs, slightly in front of the surface.
void draw_disc(Canvas& canvas, double x, double y, double z, double radius, Colour colour) {
  const int reach = static_cast<int>(std::ceil(radius));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (dx * dx + dy * dy <= radius * radius)
        canvas.put(static_cast<int>(std::lround(x)) + dx, static_cast<int>(std::lround(y)) + dy, z,
                   colour);
}

void draw_path(Canvas& canvas, const Path& path, double scale) {
  const double radius = path.width * scale / 2;
  for (size_t i = 0; path.has_joints && i < path.points.size(); ++i) {
    if (std::isnan(path.points[i].x)) continue;
    const Screen p = canvas.see(path.points[i]);
    draw_disc(canvas, p.x, p.y, p.depth + 2 * radius + 1, kJointSize * radius, path.colour);
  }
  for (size_t i = 1; i < path.points.size(); ++i) {
    if (std::isnan(path.points[i].x) || std::isnan(path.points[i - 1].x)) continue;
    const Colour colour = path.values.empty() ? path.colour : heat(path.values[i]);
    const Screen a = canvas.see(path.points[i - 1]), b = canvas.see(path.points[i]);
    const int steps =
        std::min(4000, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) * 2)) + 1);
    for (int s = 0; s <= steps; ++s) {
      const double f = static_cast<double>(s) / steps;
      const double x = a.x + (b.x - a.x) * f, y = a.y + (b.y - a.y) * f;
      const double z = a.depth + (b.depth - a.depth) * f + 2 * radius + 1;
      draw_disc(canvas, x, y, z, radius, colour);
    }
  }
}

void draw_tool(Canvas& canvas, Vec centre_m, double radius_m) {
  const Screen c = canvas.see(centre_m);
  const double radius = radius_m * canvas.pixels_per_m;
  const int reach = static_cast<int>(std::ceil(radius));
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const double rest = radius * radius - dx * dx - dy * dy;
      if (rest < 0) continue;
      const double h = std::sqrt(rest);
      const Vec normal = (canvas.right * dx - canvas.up * dy + canvas.eye * h) * (1 / radius);
      canvas.put(static_cast<int>(std::lround(c.x)) + dx, static_cast<int>(std::lround(c.y)) + dy,
                 c.depth + h, lit(canvas, normal, {96, 150, 255}));
    }
}

double fitted(const Canvas& canvas, const Scene3d& scene3d) {
  double x = 1e-9, y = 1e-9;
  const auto take = [&](Vec p) {
    if (std::isnan(p.x)) return;
    x = std::max(x, std::fabs(dot(p - canvas.centre, canvas.right)));
    y = std::max(y, std::fabs(dot(p - canvas.centre, canvas.up)));
  };
  for (const Vec& v : scene3d.vertices) take(v);
  for (const Path& path : scene3d.paths)
    for (const Vec& v : path.points) take(v);
  return kMargin / 2 * std::min(canvas.image.width / x, canvas.image.height / y);
}

}  // namespace

Image draw(const Scene3d& scene3d, uint32_t width, uint32_t height, Colour background, Vec tool_m) {
  constexpr uint32_t kOver = 2;  // drawn at twice the size and halved: smooth edges
  const double ca = std::cos(kAzimuth_rad), sa = std::sin(kAzimuth_rad);
  const double ce = std::cos(kElevation_rad), se = std::sin(kElevation_rad);
  Canvas canvas{Image(width * kOver, height * kOver, background),
                std::vector<float>(size_t{width} * height * kOver * kOver,
                                   -std::numeric_limits<float>::infinity()),
                {ca, sa, 0},
                {},
                {sa * ce, -ca * ce, se},
                scene3d.centre,
                1};
  canvas.up = cross(canvas.eye, canvas.right);
  canvas.pixels_per_m = fitted(canvas, scene3d);
  draw_mesh(canvas, scene3d);
  for (const Path& path : scene3d.paths) draw_path(canvas, path, kOver);
  if (!std::isfinite(tool_m.x)) return halved(canvas.image);
  if (scene3d.spheres.empty()) draw_tool(canvas, tool_m, scene3d.tool_radius_m);
  for (const PlacedSphere& sphere : scene3d.spheres)
    draw_tool(canvas, tool_m + sphere.centre_m, sphere.radius_m);
  return halved(canvas.image);
}

}  // namespace firmtouch::host_sim
