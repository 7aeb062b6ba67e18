// Triangles measured side by side have the bits of triangles measured in turn.
#include "firmtouch/mesh/leaf.hpp"

#include <float.h>
#include <stdint.h>

#include "firmtouch/mesh/triangle_shape.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;
namespace mesh = firmtouch::mesh;

namespace {

uint32_t g_seed = 7;
uint32_t next_random() {
  g_seed ^= g_seed << 13, g_seed ^= g_seed >> 17, g_seed ^= g_seed << 5;
  return g_seed;
}
float unit() { return static_cast<float>(next_random() >> 8) * 0x1p-23f - 1.0f; }
// Few values, so that regions' borders, ties and zeros of both signs come often.
float coarse() {
  const float values[] = {-1.0f, -0.5f, -0.0f, 0.0f, 0.5f, 1.0f, 2.0f, 0x1p-70f};
  return values[next_random() & 7u];
}
float coordinate(bool is_coarse) { return is_coarse ? coarse() : unit(); }

constexpr uint32_t kVertices = 10, kTriangles = 9;
struct Leaf {
  mesh::Vertex vertices[kVertices];
  mesh::Triangle<uint16_t> triangles[kTriangles];
  math::Vec3 p_m;

  explicit Leaf(uint32_t turn) {
    const bool is_coarse = turn % 2 == 0;
    for (mesh::Vertex& v : vertices)
      v = {coordinate(is_coarse), coordinate(is_coarse), coordinate(is_coarse)};
    for (mesh::Triangle<uint16_t>& t : triangles)
      for (uint16_t& corner : t.corner) corner = static_cast<uint16_t>(next_random() % kVertices);
    p_m = {coordinate(is_coarse) * 2.0f, coordinate(is_coarse), coordinate(is_coarse)};
    if (turn % 8 == 1) vertices[1] = vertices[0];  // two triangles that tie
    if (turn % 8 == 3) p_m.z = 50.0f;
  }
};

bool same(float a, float b) {
  return math::bits_of(a) == math::bits_of(b) || (!(a <= a) && !(b <= b));
}
bool same(math::Vec3 a, math::Vec3 b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

mesh::Foot closest_on(const Leaf& leaf, uint32_t triangle) {
  math::Vec3 at[3];
  for (uint32_t k = 0; k < 3; ++k) {
    const mesh::Vertex& v = leaf.vertices[leaf.triangles[triangle].corner[k]];
    at[k] = {v.x_m, v.y_m, v.z_m};
  }
  return mesh::closest_on_triangle(leaf.p_m, at[0], at[1], at[2]);
}

mesh::TriangleShape shape_at(const Leaf& leaf, uint32_t triangle) {
  math::Vec3 at[3];
  for (uint32_t k = 0; k < 3; ++k) {
    const mesh::Vertex& v = leaf.vertices[leaf.triangles[triangle].corner[k]];
    at[k] = {v.x_m, v.y_m, v.z_m};
  }
  return mesh::shape_of(at[0], at[1], at[2]);
}

struct Compared {
  uint32_t differ = 0, improved = 0, seen[7] = {};
};

template <class Float>
void compare_triangles(const Leaf& leaf, Compared& compared) {
  const auto corner = [&](uint32_t k) {
    const auto at = [&](uint32_t lane) {
      return &leaf.vertices[leaf.triangles[lane].corner[k]].x_m;
    };
    if constexpr (math::kLanesOf<Float> == 8)
      return math::gather(at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7));
    else
      return math::gather(at(0), at(1), at(2), at(3));
  };
  const auto feet = mesh::closest_on_triangles<Float>(leaf.p_m, corner(0), corner(1), corner(2));
  const auto features = feet.features();
  for (uint32_t lane = 0; lane < math::kLanesOf<Float>; ++lane) {
    const mesh::Foot foot = closest_on(leaf, lane);
    const math::Vec3 offset_m{feet.offset_m.x[lane], feet.offset_m.y[lane], feet.offset_m.z[lane]};
    if (!same(offset_m, foot.offset_m) || !same(feet.distance2_m2[lane], foot.distance2_m2) ||
        static_cast<uint32_t>(features[lane]) != static_cast<uint32_t>(foot.feature))
      ++compared.differ;
    ++compared.seen[static_cast<uint32_t>(foot.feature)];
  }
}

float measured_in_turn(const Leaf& leaf, uint32_t child, float least2_m2, mesh::Best& best) {
  for (uint32_t i = mesh::leaf_first(child), n = mesh::leaf_count(child); n-- > 0; ++i) {
    const mesh::Foot foot = closest_on(leaf, i);
    if (!(foot.distance2_m2 < least2_m2)) continue;
    least2_m2 = foot.distance2_m2;
    best = {least2_m2, foot.offset_m, i, 5, foot.feature};
  }
  return least2_m2;
}

// The same leaf side by side, anywhere in a block, what lies about it being no triangle's.
template <class Float>
void compare_lined(const Leaf& leaf, uint32_t child, float in_turn, const mesh::Best& a,
                   float bound2_m2, Compared& compared) {
  const uint32_t first = mesh::leaf_first(child), count = mesh::leaf_count(child);
  uint32_t before = next_random() % (first + 1), behind = next_random() % 3;
  if (before + count > mesh::kMostLanes) before = mesh::kMostLanes - count;
  if (before + count + behind > mesh::kMostLanes) behind = mesh::kMostLanes - count - before;
  const mesh::Block block{first - before, before + count + behind};
  float corners[mesh::kRowsOfCorners * (kTriangles + 3) + mesh::kMostLanes];
  for (float& f : corners) f = coordinate(true);
  float shapes[mesh::kRowsOfShapes * kTriangles + mesh::kMostLanes];
  for (float& f : shapes) f = coordinate(true);
  for (uint32_t i = 0; i < count; ++i) {
    float values[mesh::kRowsOfShapes];
    mesh::put_rows(shape_at(leaf, first + i), values);
    for (uint32_t row = 0; row < mesh::kRowsOfShapes; ++row)
      shapes[mesh::kRowsOfShapes * first + row * count + i] = values[row];
    for (uint32_t row = 0; row < mesh::kRowsOfCorners; ++row) {
      const mesh::Vertex& v = leaf.vertices[leaf.triangles[first + i].corner[row / 3]];
      corners[mesh::kRowsOfCorners * block.first + row * block.count + before + i] =
          row % 3 == 0   ? v.x_m
          : row % 3 == 1 ? v.y_m
                         : v.z_m;
    }
  }
  mesh::Ahead ahead{};
  ahead.corners = corners;
  ahead.shapes = shapes;
  const mesh::Lined lined(ahead, mesh::make_lined(child, block));
  for (uint32_t way = 0; way < (bound2_m2 < FLT_MAX ? 2 : 4); ++way) {
    mesh::Best b;
    const uint32_t last = way == 2 ? a.triangle : next_random() & 0xFFFFu;
    float told;
    if (way == 0)
      told = mesh::measure_lined<Float>(lined, leaf.p_m, 5, bound2_m2, b);
    else if (way == 1)
      told = mesh::measure_lined_beside<Float>(lined, leaf.p_m, 5, bound2_m2, b);
    else
      told = mesh::measure_lined_last<Float>(lined, leaf.p_m, 5, last, b);
    if (!same(in_turn, told) || !same(a.offset_m, b.offset_m) ||
        !same(a.distance2_m2, b.distance2_m2) || a.triangle != b.triangle || a.place != b.place ||
        a.feature != b.feature)
      ++compared.differ;
  }
}

template <class Float>
void compare_leaves(const Leaf& leaf, uint32_t turn, Compared& compared) {
  constexpr uint32_t kLanes = math::kLanesOf<Float>;
  const mesh::Loss loss(mesh::Head{});
  // Of as many triangles as a Float holds or of more, so that leaves lie at the end, too.
  const uint32_t held = turn % 7 == 0 ? kTriangles : kLanes, first = turn % 3;
  const firmtouch::core::Span<const mesh::Triangle<uint16_t>> triangles(leaf.triangles, held);
  const uint32_t rest = held - first, most = rest < kLanes ? rest : kLanes;
  const uint32_t child = mesh::make_leaf(first, 1 + turn % (most < 7 ? most : 7));
  const float bound2_m2 = turn % 5 == 0 ? 0.25f : FLT_MAX;
  mesh::Best a, b, c, d;
  const float in_turn = measured_in_turn(leaf, child, bound2_m2, a);
  const float told[] = {
      mesh::measure_side_by_side<Float>(leaf.vertices, triangles, leaf.p_m, child, 5, bound2_m2, b),
      mesh::measure_leaf<false>(leaf.vertices, triangles, loss, leaf.p_m, child, 5, false,
                                bound2_m2, c),
      mesh::measure_leaf<false>(leaf.vertices, triangles, loss, leaf.p_m, child, 5, true, bound2_m2,
                                d)};
  const mesh::Best* const others[] = {&b, &c, &d};
  for (uint32_t k = 0; k < 3; ++k) {
    const mesh::Best& other = *others[k];
    if (!same(in_turn, told[k]) || !same(a.offset_m, other.offset_m) ||
        !same(a.distance2_m2, other.distance2_m2) || a.triangle != other.triangle ||
        a.place != other.place || a.feature != other.feature)
      ++compared.differ;
  }
  compare_lined<Float>(leaf, child, in_turn, a, bound2_m2, compared);
  compared.improved += in_turn < bound2_m2 ? 1u : 0u;
}

// Turned so that edge 0 is the longest, as the baker turns them.
void turn_longest_first(Leaf& leaf) {
  for (mesh::Triangle<uint16_t>& t : leaf.triangles) {
    float longest2_m2 = -1;
    mesh::Triangle<uint16_t> turned = t;
    for (uint32_t k = 0; k < 3; ++k) {
      const mesh::Triangle<uint16_t> now = {
          {t.corner[k], t.corner[(k + 1) % 3], t.corner[(k + 2) % 3]}};
      const mesh::Vertex &u = leaf.vertices[now.corner[0]], &v = leaf.vertices[now.corner[1]];
      const math::Vec3 edge{v.x_m - u.x_m, v.y_m - u.y_m, v.z_m - u.z_m};
      if (math::dot(edge, edge) > longest2_m2) turned = now, longest2_m2 = math::dot(edge, edge);
    }
    t = turned;
  }
}

// Thin ones too, and what is only just nearer than another or as near.
template <class Float>
void compare_what_may_be_nearer(uint32_t turn, Compared& wrong_and_left_out) {
  Leaf leaf(turn);
  if (turn % 3 == 0)
    for (mesh::Vertex& v : leaf.vertices) v.y_m *= turn % 2 == 0 ? 0x1p-6f : 0x1p-12f;
  turn_longest_first(leaf);
  constexpr uint32_t kLanes = math::kLanesOf<Float>;
  float x[3][3][kLanes];
  for (uint32_t lane = 0; lane < kLanes; ++lane)
    for (uint32_t k = 0; k < 3; ++k) {
      const mesh::Vertex& v = leaf.vertices[leaf.triangles[lane].corner[k]];
      x[k][0][lane] = v.x_m, x[k][1][lane] = v.y_m, x[k][2][lane] = v.z_m;
    }
  math::Lanes<Float> corner[3];
  for (uint32_t k = 0; k < 3; ++k)
    corner[k] = {math::lanes_from<Float>(x[k][0]), math::lanes_from<Float>(x[k][1]),
                 math::lanes_from<Float>(x[k][2])};
  const auto frames = mesh::frames_of<Float>(corner[0], corner[1], corner[2]);
  const auto feet = mesh::plane_feet<Float>(frames, leaf.p_m);
  for (uint32_t other = 0; other < kLanes; ++other) {
    const float told2_m2 = closest_on(leaf, other).distance2_m2;
    if (!(told2_m2 <= FLT_MAX)) continue;
    const float scales[] = {1.0f, 1.0f + 0x1p-20f, 1.0f - 0x1p-20f, 0.9f};
    for (const float scale : scales) {
      const float least2_m2 = told2_m2 * scale;
      const uint32_t may_be = mesh::may_be_nearer(frames, feet, least2_m2);
      for (uint32_t lane = 0; lane < kLanes; ++lane) {
        if ((may_be >> lane & 1u) != 0) continue;
        ++wrong_and_left_out.improved;
        if (!(closest_on(leaf, lane).distance2_m2 > least2_m2)) ++wrong_and_left_out.differ;
      }
    }
  }
}

bool same(const mesh::Best& a, const mesh::Best& b) {
  return same(a.offset_m, b.offset_m) && same(a.distance2_m2, b.distance2_m2) &&
         a.triangle == b.triangle && a.place == b.place && a.feature == b.feature;
}

}  // namespace

TEST(WhatCannotBeNearerIsToldFarther) {
  Compared four, wide;
  constexpr uint32_t kTurns = 20000;
  for (uint32_t turn = 0; turn < kTurns; ++turn) {
    compare_what_may_be_nearer<math::Float4>(turn, four);
    compare_what_may_be_nearer<math::FloatWide>(turn, wide);
  }
  CHECK_EQ(four.differ, 0u);
  CHECK_EQ(wide.differ, 0u);
  CHECK_LT(kTurns * 10, four.improved);
}

TEST(TrianglesSideBySideHaveTheBitsOfTheOne) {
  Compared compared;
  for (uint32_t turn = 0; turn < 4000; ++turn) {
    const Leaf leaf(turn);
    compare_triangles<math::Float4>(leaf, compared);
    compare_triangles<math::FloatWide>(leaf, compared);
  }
  CHECK_EQ(compared.differ, 0u);
  for (const uint32_t times : compared.seen) CHECK(times > 200u);
}

// Without and with what is certainly no nearer left out, from the same bound, by corners and by shapes.
TEST(ALeafOfWhichSomeIsLeftOutTellsWhatTheWholeTells) {
  Compared compared;
  for (uint32_t turn = 0; turn < 20000; ++turn) {
    const Leaf leaf(turn);
    float longest_m = 0;
    for (const mesh::Triangle<uint16_t>& t : leaf.triangles)
      for (uint32_t k = 0; k < 3; ++k) {
        const mesh::Vertex& u = leaf.vertices[t.corner[k]];
        const mesh::Vertex& v = leaf.vertices[t.corner[(k + 1) % 3]];
        const float edge_m =
            math::length(math::Vec3{v.x_m, v.y_m, v.z_m} - math::Vec3{u.x_m, u.y_m, u.z_m});
        longest_m = edge_m > longest_m ? edge_m : longest_m;
      }
    mesh::Sought all;
    all.p_m = leaf.p_m;
    all.slack_m2 = mesh::Nearer::slack_m2(longest_m);
    all.vertices = leaf.vertices;
    all.triangles = leaf.triangles;
    const mesh::Foot any = closest_on(leaf, next_random() % kTriangles);
    all.best.distance2_m2 = turn % 3 == 0 ? FLT_MAX : any.distance2_m2;
    mesh::Sought nearer = all;
    const uint32_t count = 1 + turn % 7;
    const uint32_t child = mesh::make_leaf(next_random() % (kTriangles - count + 1), count);
    mesh::Sought by_shapes = all, nearer_by_shapes = all;
    mesh::TriangleShape shapes[kTriangles];
    for (uint32_t t = 0; t < kTriangles; ++t) shapes[t] = shape_at(leaf, t);
    by_shapes.shapes = nearer_by_shapes.shapes = shapes;
    mesh::Triangle<uint32_t> wide[kTriangles];
    for (uint32_t t = 0; t < kTriangles; ++t)
      for (uint32_t k = 0; k < 3; ++k) wide[t].corner[k] = leaf.triangles[t].corner[k];
    by_shapes.is_narrow = nearer_by_shapes.is_narrow = turn % 2 == 0;
    if (turn % 2 != 0) by_shapes.triangles = nearer_by_shapes.triangles = wide;
    mesh::measure_in_turn<mesh::CornersInTurn<uint16_t>, mesh::Everything>(child, 5, all);
    mesh::measure_in_turn<mesh::CornersInTurn<uint16_t>, mesh::Nearer>(child, 5, nearer);
    mesh::measure_in_turn<mesh::ShapesInTurn, mesh::Everything>(child, 5, by_shapes);
    mesh::measure_in_turn<mesh::ShapesInTurn, mesh::Nearer>(child, 5, nearer_by_shapes);
    compared.differ += same(all.best, nearer.best) ? 0u : 1u;
    compared.differ += same(all.best, by_shapes.best) ? 0u : 1u;
    compared.differ += same(all.best, nearer_by_shapes.best) ? 0u : 1u;
    compared.improved += all.best.place == 5 ? 1u : 0u;
  }
  CHECK_EQ(compared.differ, 0u);
  CHECK(compared.improved > 8000u);
}

TEST(ALeafSideBySideTellsWhatALeafInTurnTells) {
  Compared compared;
  for (uint32_t turn = 0; turn < 4000; ++turn) {
    Leaf leaf(turn);
    turn_longest_first(leaf);
    compare_leaves<math::Float4>(leaf, turn, compared);
    compare_leaves<math::FloatWide>(leaf, turn, compared);
  }
  CHECK_EQ(compared.differ, 0u);
  CHECK(compared.improved > 6000u);
}
