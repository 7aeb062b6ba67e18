// Triangles measured side by side have the bits of triangles measured in turn.
#include "firmtouch/mesh/leaf.hpp"

#include "harness/test.hpp"
#include "random_leaf.hpp"

namespace {

using namespace mesh_test;  // NOLINT: a test file

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
  const float reported[] = {
      mesh::measure_side_by_side<Float>(leaf.vertices, triangles, leaf.p_m, child, 5, bound2_m2, b),
      mesh::measure_leaf<false>(leaf.vertices, triangles, loss, leaf.p_m, child, 5, false,
                                bound2_m2, c),
      mesh::measure_leaf<false>(leaf.vertices, triangles, loss, leaf.p_m, child, 5, true, bound2_m2,
                                d)};
  const mesh::Best* const others[] = {&b, &c, &d};
  for (uint32_t k = 0; k < 3; ++k) {
    const mesh::Best& other = *others[k];
    if (!same(in_turn, reported[k]) || !same(a.offset_m, other.offset_m) ||
        !same(a.distance2_m2, other.distance2_m2) || a.triangle != other.triangle ||
        a.slot != other.slot || a.feature != other.feature)
      ++compared.differ;
  }
  compared.improved += in_turn < bound2_m2 ? 1u : 0u;
}

}  // namespace

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
    mesh::Sought all;
    all.p_m = leaf.p_m;
    all.slack_m2 = mesh::Nearer::slack_m2(longest_edge_m(leaf));
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
    compared.improved += all.best.slot == 5 ? 1u : 0u;
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
