#include "surface/edges.hpp"

#include <algorithm>

#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

template <class Take>
void each_length_m(const Surface& surface, const Take& take) {
  for (const Face& face : surface.faces)
    for (size_t k = 0; k < 3; ++k)
      take(length(to_point(surface.vertices[face[(k + 1) % 3]]) -
                  to_point(surface.vertices[face[k]])));
}

}  // namespace

double mean_edge_m(const Surface& surface) {
  double sum_m = 0;
  each_length_m(surface, [&](double edge_m) { sum_m += edge_m; });
  return sum_m / (3 * static_cast<double>(surface.faces.size()));
}

double longest_edge_m(const Surface& surface) {
  double longest_m = 0;
  each_length_m(surface, [&](double edge_m) { longest_m = std::max(longest_m, edge_m); });
  return longest_m;
}

Edges::Edges(const std::vector<Face>& faces) {
  struct Key {
    uint32_t low, high, half;
  };
  std::vector<Key> keys(faces.size() * 3);
  for (uint32_t h = 0; h < keys.size(); ++h) {
    const uint32_t a = start_of(faces, h), b = end_of(faces, h);
    keys[h] = {std::min(a, b), std::max(a, b), h};
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.half < b.half;
  });
  halves_.resize(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    halves_[i] = keys[i].half;
    if (i == 0 || keys[i].low != keys[i - 1].low || keys[i].high != keys[i - 1].high) {
      edges_.push_back({keys[i].low, keys[i].high, halves_.data() + i, 0});
    }
    ++edges_.back().count;
  }
}

std::vector<uint32_t> Edges::mates() const {
  std::vector<uint32_t> mates(halves_.size(), kNone);
  for (const Edge& edge : edges_) {
    if (edge.count != 2) continue;
    mates[edge.half[0]] = edge.half[1];
    mates[edge.half[1]] = edge.half[0];
  }
  return mates;
}

uint32_t Edges::open_count() const {
  return static_cast<uint32_t>(std::count_if(edges_.begin(), edges_.end(),
                                             [](const Edge& edge) { return edge.count == 1; }));
}

uint32_t Edges::crowded_count() const {
  return static_cast<uint32_t>(
      std::count_if(edges_.begin(), edges_.end(), [](const Edge& edge) { return edge.count > 2; }));
}

Sets::Sets(size_t count) : parent_(count) {
  for (uint32_t i = 0; i < count; ++i) parent_[i] = i;
}

uint32_t Sets::find(uint32_t item) {
  while (parent_[item] != item) {
    parent_[item] = parent_[parent_[item]];
    item = parent_[item];
  }
  return item;
}

void Sets::join(uint32_t a, uint32_t b) {
  const uint32_t x = find(a), y = find(b);
  if (x < y) {
    parent_[y] = x;
  } else {
    parent_[x] = y;
  }
}

Sets corner_fans(const std::vector<Face>& faces, const std::vector<uint32_t>& mates) {
  Sets fans(faces.size() * 3);
  for (uint32_t h = 0; h < mates.size(); ++h) {
    const uint32_t mate = mates[h];
    if (mate == kNone || mate < h) continue;
    const bool same_way = start_of(faces, h) == start_of(faces, mate);
    fans.join(h, same_way ? mate : next_half(mate));
    fans.join(next_half(h), same_way ? next_half(mate) : mate);
  }
  return fans;
}

}  // namespace firmtouch::tools
