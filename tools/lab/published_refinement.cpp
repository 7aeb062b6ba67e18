#include "lab/published_refinement.hpp"

#include <algorithm>

#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

Face lowest_first(Face face) {
  while (face[0] > face[1] || face[0] > face[2]) face = {face[1], face[2], face[0]};
  return face;
}

bool clip(double low, double high, double from, double to, double& begin, double& end) {
  const double along = to - from;
  if (!(along > 0 || along < 0)) return from >= low && from <= high;
  const double a = (low - from) / along, b = (high - from) / along;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
  return begin <= end;
}

}  // namespace

Refinement::Refinement(const ProgressiveHull& hull, uint32_t base_faces) : hull_(hull) {
  const uint32_t all = static_cast<uint32_t>(hull.mesh_faces.size());
  cut_ = std::min(base_faces >= all ? 0 : (all - base_faces + 1) / 2,
                  static_cast<uint32_t>(hull.collapses.size()));
  base_ = hull_after(hull, cut_);
  is_split_.assign(cut_, false);
  low_m_ = high_m_ = to_point(hull.vertices_m[base_.faces[0][0]]);
  for (const Face& face : base_.faces) {
    for (const uint32_t corner : face) {
      const Point p = to_point(hull.vertices_m[corner]);
      low_m_ = {std::min(low_m_.x, p.x), std::min(low_m_.y, p.y), std::min(low_m_.z, p.z)};
      high_m_ = {std::max(high_m_.x, p.x), std::max(high_m_.y, p.y), std::max(high_m_.z, p.z)};
    }
  }
  for (uint32_t f = 0; f < all; ++f) by_corners_.push_back({lowest_first(hull.mesh_faces[f]), f});
  std::sort(by_corners_.begin(), by_corners_.end());
}

bool Refinement::is_of_mesh(const Face& face) const {
  return std::max({face[0], face[1], face[2]}) < hull_.mesh_vertices;
}

bool Refinement::is_made(const Face& face) const {
  return is_of_mesh(face) ||
         !is_split_[std::max({face[0], face[1], face[2]}) - hull_.mesh_vertices];
}

Face Refinement::star_face(const Collapse& collapse, uint32_t i) const {
  const uint32_t* link = &hull_.links[collapse.first_link];
  if (i < collapse.link_count) {
    const uint32_t next = i + 1 == collapse.link_count ? 0 : i + 1;
    return {i < collapse.split ? collapse.u : collapse.v, link[i], link[next]};
  }
  return i == collapse.link_count ? Face{collapse.u, collapse.v, link[0]}
                                  : Face{collapse.v, collapse.u, link[collapse.split]};
}

void Refinement::request_split(uint32_t collapse) {
  if (is_split_[collapse]) return;
  const auto add = [this](uint32_t k) {
    if (k >= cut_ || is_split_[k]) return;
    is_split_[k] = true;
    split_.push_back(k);
  };
  size_t closed = split_.size();
  add(collapse);
  for (; closed < split_.size(); ++closed) {
    const Collapse& c = hull_.collapses[split_[closed]];
    add(hull_.removed_by[hull_.mesh_vertices + split_[closed]]);
    for (uint32_t i = 0; i < c.link_count; ++i)
      add(hull_.removed_by[hull_.links[c.first_link + i]]);
  }
}

void Refinement::request_corners(const Face& face) {
  for (const uint32_t corner : face) {
    if (corner >= hull_.mesh_vertices) request_split(corner - hull_.mesh_vertices);
  }
}

void Refinement::collapse_all() {
  for (const uint32_t k : split_) is_split_[k] = false;
  split_.clear();
  kept_ = 0;
}

// What a collapse needs has a higher number, so each is looked at after all that may need it.
void Refinement::coarsen() {
  std::sort(split_.begin(), split_.end());
  std::vector<bool> is_needed(cut_, false);
  std::vector<uint32_t> left;
  for (const uint32_t k : split_) {
    if (!is_needed[k] && !is_crossed_[k]) {
      is_split_[k] = false;
      continue;
    }
    left.push_back(k);
    const Collapse& c = hull_.collapses[k];
    const auto need = [&](uint32_t vertex) {
      if (hull_.removed_by[vertex] < cut_) is_needed[hull_.removed_by[vertex]] = true;
    };
    need(hull_.mesh_vertices + k);
    for (uint32_t i = 0; i < c.link_count; ++i) need(hull_.links[c.first_link + i]);
  }
  split_ = left;
}

uint32_t Refinement::mesh_face(const Face& face) const {
  const std::pair<Face, uint32_t> wanted{lowest_first(face), 0};
  return std::lower_bound(by_corners_.begin(), by_corners_.end(), wanted)->second;
}

// Source: Moeller & Trumbore 1997.
bool Refinement::crosses(const Face& face, const Segment& segment, double& t) const {
  const Point a = to_point(hull_.vertices_m[face[0]]);
  const Point ab = to_point(hull_.vertices_m[face[1]]) - a,
              ac = to_point(hull_.vertices_m[face[2]]) - a;
  const Point along = segment.to_m - segment.from_m, p = cross(along, ac);
  const double det = dot(ab, p);
  if (!(det > 0 || det < 0)) return false;
  const Point from = segment.from_m - a, q = cross(from, ab);
  const double u = dot(from, p) / det, v = dot(along, q) / det;
  t = dot(ac, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}

bool Refinement::touches_box(const Segment& s) const {
  double begin = 0, end = 1;
  return clip(low_m_.x, high_m_.x, s.from_m.x, s.to_m.x, begin, end) &&
         clip(low_m_.y, high_m_.y, s.from_m.y, s.to_m.y, begin, end) &&
         clip(low_m_.z, high_m_.z, s.from_m.z, s.to_m.z, begin, end);
}

std::vector<SegmentHit> Refinement::hits(const Segment& segment, RefinementCounts& counts) {
  std::vector<SegmentHit> found;
  if (!touches_box(segment)) return found;
  const size_t before = split_.size();
  is_crossed_.assign(coarsens_ ? cut_ : 0, false);
  const auto test = [&](const Face& face) {
    ++counts.tests;
    double t = 0;
    if (!crosses(face, segment, t)) return false;
    if (is_of_mesh(face)) {
      found.push_back({t, mesh_face(face)});
    } else {
      request_corners(face);
    }
    return true;
  };
  for (const Face& face : base_.faces) {
    if (is_made(face)) (void)test(face);
  }
  for (size_t head = 0; head < split_.size(); ++head) {
    const Collapse& collapse = hull_.collapses[split_[head]];
    for (uint32_t i = 0; i < collapse.link_count + 2; ++i) {
      const Face face = star_face(collapse, i);
      if (is_made(face) && test(face) && coarsens_) is_crossed_[split_[head]] = true;
    }
  }
  counts.splits += split_.size() - before;
  if (coarsens_) {
    coarsen();
  } else if (++kept_ >= keep_) {
    collapse_all();
  }
  std::sort(found.begin(), found.end(), [](const SegmentHit& a, const SegmentHit& b) {
    return a.t < b.t || (!(b.t < a.t) && a.face < b.face);
  });
  return found;
}

std::vector<Face> Refinement::all_split() {
  for (uint32_t k = 0; k < cut_; ++k) request_split(k);
  std::vector<Face> faces;
  for (const Face& face : base_.faces) {
    if (is_made(face)) faces.push_back(face);
  }
  for (const uint32_t k : split_) {
    const Collapse& collapse = hull_.collapses[k];
    for (uint32_t i = 0; i < collapse.link_count + 2; ++i) {
      const Face face = star_face(collapse, i);
      if (is_made(face)) faces.push_back(face);
    }
  }
  collapse_all();
  return faces;
}

}  // namespace firmtouch::tools
