#include "bake/hull/hull_encoder.hpp"

#include <algorithm>
#include <cmath>

#include "bake/hull/bake_base_hull.hpp"
#include "bake/hull/filled_boxes.hpp"
#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

Face lowest_first(Face face) {
  while (face[0] > face[1] || face[0] > face[2]) face = {face[1], face[2], face[0]};
  return face;
}

// 42 bits of reaches and 6 of the exponent.
hull::StarBox packed(const uint32_t (&reach)[6], uint32_t exponent) {
  uint64_t bits = uint64_t{exponent} << 42;
  for (uint32_t i = 0; i < 6; ++i) bits |= uint64_t{reach[i]} << (7 * i);
  hull::StarBox box{};
  for (uint32_t i = 0; i < 6; ++i) box.bits[i] = static_cast<uint8_t>(bits >> (8 * i));
  return box;
}

}  // namespace

HullEncoder::HullEncoder(const ProgressiveHull& hull, const mesh::View& mesh)
    : hull_(hull), mesh_(mesh) {
  make_head();
  for (uint32_t f = 0; f < hull.mesh_faces.size(); ++f)
    by_corners_.push_back({lowest_first(hull.mesh_faces[f]), f});
  std::sort(by_corners_.begin(), by_corners_.end());
}

void HullEncoder::make_head() {
  head_.mesh_vertex_count = hull_.mesh_vertices;
  head_.mesh_triangle_count = static_cast<uint32_t>(hull_.mesh_faces.size());
  head_.collapse_count = static_cast<uint32_t>(hull_.collapses.size());
  const uint32_t most =
      std::max(head_.mesh_vertex_count + head_.collapse_count, head_.mesh_triangle_count);
  head_.id_bytes = most <= 65536 ? 2 : 3;
  head_.coordinate_bytes = hull_.grid.bits <= 16 ? 2 : 3;
  const double low[3] = {hull_.grid.low_m.x, hull_.grid.low_m.y, hull_.grid.low_m.z};
  for (int k = 0; k < 3; ++k) head_.grid_low_m[k] = static_cast<float>(low[k]);
  head_.cell_m = static_cast<float>(hull_.grid.cell_m);
  hull::Box box = box_of_point(hull_.vertices_m[0]);
  for (const math::Vec3& v : hull_.vertices_m) grow(box, box_of_point(v));
  std::copy(box.low_m, box.low_m + 3, head_.low_m);
  std::copy(box.high_m, box.high_m + 3, head_.high_m);
}

std::string HullEncoder::problem() const {
  if (uint64_t{head_.mesh_vertex_count} + head_.collapse_count > hull::kMaxIds)
    return "has too many vertices for a hull: at most " + std::to_string(hull::kMaxIds) +
           " with those of its hulls; simplify the model";
  return "";
}

void HullEncoder::assign_ids() {
  id_.assign(hull_.vertices_m.size(), kNone);
  for (uint32_t k = 0; k < head_.collapse_count; ++k) {
    id_[hull_.collapses[k].u] = 2 * k;
    id_[hull_.collapses[k].v] = 2 * k + 1;
  }
  uint32_t next = 2 * head_.collapse_count;
  for (uint32_t& id : id_)
    if (id == kNone) id = next++;
  numbers_.resize(id_.size());
  for (uint32_t n = 0; n < id_.size(); ++n) numbers_[id_[n]] = n;
  for (const uint32_t n : numbers_) put_id(origins_, n);
}

void HullEncoder::put_id(std::vector<uint8_t>& bytes, uint32_t value) const {
  for (uint32_t k = 0; k < head_.id_bytes; ++k)
    bytes.push_back(static_cast<uint8_t>(value >> (8 * k)));
}

void HullEncoder::put_vertices() {
  const HullGrid& grid = hull_.grid;
  for (uint32_t k = 0; k < head_.collapse_count; ++k) {
    const Point v = to_point(hull_.vertices_m[hull_.mesh_vertices + k]) - grid.low_m;
    for (const double side : {v.x, v.y, v.z}) {
      const uint32_t steps = static_cast<uint32_t>(std::floor(side / grid.cell_m + 0.5));
      for (uint32_t i = 0; i < head_.coordinate_bytes; ++i)
        vertices_.push_back(static_cast<uint8_t>(steps >> (8 * i)));
    }
  }
}

std::vector<Face> HullEncoder::star_faces(uint32_t collapse) const {
  const Collapse& c = hull_.collapses[collapse];
  const uint32_t* link = &hull_.links[c.first_link];
  std::vector<Face> faces;
  for (uint32_t i = 0; i < c.link_count; ++i)
    faces.push_back({i < c.split ? c.u : c.v, link[i], link[i + 1 == c.link_count ? 0 : i + 1]});
  faces.push_back({c.u, c.v, link[0]});
  faces.push_back({c.v, c.u, link[c.split]});
  return faces;
}

uint32_t HullEncoder::triangle_of(const Face& numbers) const {
  const std::pair<Face, uint32_t> wanted{lowest_first(numbers), 0};
  return std::lower_bound(by_corners_.begin(), by_corners_.end(), wanted)->second;
}

void HullEncoder::put_records() {
  for (uint32_t k = 0; k < head_.collapse_count; ++k) {
    if (k % hull::kRecordsPerOffset == 0) places_.push_back(static_cast<uint32_t>(records_.size()));
    const Collapse& c = hull_.collapses[k];
    std::vector<uint32_t> triangles;
    for (const Face& face : star_faces(k))
      if (std::max({face[0], face[1], face[2]}) < hull_.mesh_vertices)
        triangles.push_back(triangle_of(face));
    const uint32_t word =
        hull::record_head(c.link_count, c.split, static_cast<uint32_t>(triangles.size()));
    records_.push_back(static_cast<uint8_t>(word));
    records_.push_back(static_cast<uint8_t>(word >> 8));
    put_id(records_, id_[hull_.mesh_vertices + k]);
    for (uint32_t i = 0; i < c.link_count; ++i)
      put_id(records_, id_[hull_.links[c.first_link + i]]);
    for (const uint32_t t : triangles) put_id(records_, t);
    star_boxes_.push_back(star_box(k));
  }
  head_.record_bytes = static_cast<uint32_t>(records_.size());
}

// The least exponent whose reaches fit, widened until the reader's own floats enclose the star.
hull::StarBox HullEncoder::star_box(uint32_t collapse) const {
  const math::Vec3 about = hull_.vertices_m[hull_.mesh_vertices + collapse];
  const std::vector<Face> faces = star_faces(collapse);
  hull::Box star = box_of_point(hull_.vertices_m[faces[0][0]]);
  for (const Face& face : faces)
    for (const uint32_t n : face) grow(star, box_of_point(hull_.vertices_m[n]));
  const double at[3] = {double{about.x}, double{about.y}, double{about.z}};
  for (uint32_t exponent = 0;; ++exponent) {
    const double unit = double{head_.cell_m} * std::ldexp(1.0, static_cast<int>(exponent));
    uint32_t reach[6];
    bool fits = true;
    for (uint32_t k = 0; k < 3; ++k) {
      const double below = std::ceil((at[k] - double{star.low_m[k]}) / unit),
                   above = std::ceil((double{star.high_m[k]} - at[k]) / unit);
      fits = fits && below <= hull::kMaxReach && above <= hull::kMaxReach;
      reach[2 * k] = fits ? static_cast<uint32_t>(std::max(below, 0.0)) : 0;
      reach[2 * k + 1] = fits ? static_cast<uint32_t>(std::max(above, 0.0)) : 0;
    }
    if (!fits) continue;
    const hull::StarBox box = packed(reach, exponent);
    const hull::Box read = hull::star_box_m(about, head_.cell_m, box);
    if (hull::holds(read, {star.low_m[0], star.low_m[1], star.low_m[2]}) &&
        hull::holds(read, {star.high_m[0], star.high_m[1], star.high_m[2]}))
      return box;
  }
}

std::vector<hull::NodeBox> HullEncoder::triangle_boxes() const {
  const mesh::Head& head = mesh_.head();
  hull::Box whole{};
  std::copy(head.low_m, head.low_m + 3, whole.low_m);
  std::copy(head.high_m, head.high_m + 3, whole.high_m);
  return filled_boxes(head.triangle_count, hull::kLeafTriangles, BoxesWithin::kParent, whole,
                      [&](uint32_t i) {
                        const mesh::Triangle<uint32_t> t = mesh_.triangle(i);
                        hull::Box box = box_of_point(mesh_.vertex(t.corner[0]));
                        for (const uint32_t corner : t.corner)
                          grow(box, box_of_point(mesh_.vertex(corner)));
                        return box;
                      });
}

std::vector<uint8_t> HullEncoder::coarsest() const {
  BaseHullSource source;
  source.head = head_;
  source.cut = head_.collapse_count;
  for (const Face& face : hull_after(hull_, source.cut).faces) {
    source.faces.push_back({id_[face[0]], id_[face[1]], id_[face[2]]});
    const bool is_of_mesh = std::max({face[0], face[1], face[2]}) < hull_.mesh_vertices;
    source.triangles.push_back(is_of_mesh ? triangle_of(face) : kNone);
  }
  source.numbers = numbers_;
  source.vertices_m = hull_.vertices_m;
  source.coordinates = vertices_.data();
  return encode_base_hull(source);
}

std::vector<Section> HullEncoder::run(const std::string& name) {
  assign_ids();
  put_vertices();
  put_records();
  std::vector<Section> sections{make_section(hull::kHeadSection, name, &head_, 1)};
  const auto add = [&](uint32_t type, const auto& items) {
    if (!items.empty()) sections.push_back(make_section(type, name, items));
  };
  add(hull::kVerticesSection, vertices_);
  add(hull::kOriginsSection, origins_);
  add(hull::kRecordsSection, records_);
  add(hull::kRecordOffsetsSection, places_);
  add(hull::kStarBoxesSection, star_boxes_);
  add(hull::kBoxesSection, triangle_boxes());
  add(hull::kBaseHullSection, coarsest());
  return sections;
}

}  // namespace firmtouch::tools
