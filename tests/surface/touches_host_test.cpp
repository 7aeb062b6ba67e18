// Corners, edges and faces that touch the surface elsewhere: found exactly, rejected if the sign
// of a nearest point could come from the wrong sheet, accepted where only convex ones meet.
#include "shapes.hpp"
#include "surface/check/check.hpp"

namespace firmtouch::tools {
namespace {

// A tetrahedron, outward, with its first corner at `tip` and the others at `tip` + a, b, c.
Surface spike(math::Vec3 tip, math::Vec3 a, math::Vec3 b, math::Vec3 c) {
  const auto plus = [&](math::Vec3 v) { return math::Vec3{tip.x + v.x, tip.y + v.y, tip.z + v.z}; };
  Surface surface = numbered({tip, plus(a), plus(b), plus(c)}, tetrahedron().faces);
  if (volume_of(surface) < 0)
    for (Face& face : surface.faces) turn(face);
  return surface;
}

Surface cube_and(const Surface& other) {
  Surface surface = cube();
  append(surface, other);
  return surface;
}

// Upright over the cube's top, standing on its tip.
Surface on_tip(math::Vec3 tip) {
  return spike(tip, {0.25f, 0, 1}, {-0.25f, 0.25f, 1}, {-0.25f, -0.25f, 1});
}

std::string refusal(Surface surface, CheckOptions options = {}) {
  const CheckReport report = check_and_mend(surface, options);
  return report.refused.empty() ? "" : report.refused.back();
}

// A square ring of one piece that is cut through on its left and closed again without a gap.
// `ends`: how much lower than the other the one end face's inner corner lies.
Surface cut_ring(float ends) {
  const float path[12][2] = {{0, 1.5f},        {0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 1.5f},
                             {1, 1.5f - ends}, {1, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 1.5f}};
  Surface surface;
  for (int z = 0; z < 2; ++z)
    for (const auto& p : path) surface.vertices.push_back({p[0], p[1], static_cast<float>(z)});
  for (uint32_t k = 0; k < 12; ++k) {
    const uint32_t a = k, b = (k + 1) % 12;
    surface.faces.push_back({a, b, b + 12});
    surface.faces.push_back({a, b + 12, a + 12});
  }
  for (uint32_t k = 0; k < 5; ++k) {  // the caps: outer points k and k + 1, inner 11 - k and 10 - k
    const uint32_t a = k, b = k + 1, c = 10 - k, d = 11 - k;
    surface.faces.push_back({a, c, b});
    surface.faces.push_back({a, d, c});
    surface.faces.push_back({a + 12, b + 12, c + 12});
    surface.faces.push_back({a + 12, c + 12, d + 12});
  }
  return numbered(surface.vertices, surface.faces);
}

}  // namespace

TEST(ACornerOnAFaceIsRefusedWithBoth) {
  const std::string text = refusal(cube_and(on_tip({0.25f, 0.125f, 1})));
  CHECK(says(text, "has 1 vertex and 0 edges that touch a face or an edge elsewhere"));
  CHECK(says(text, "first vertex 8 (0.25, 0.125, 1 m) on face 2,"));
  CHECK(says(text, "unite or part") && says(text, "--unsigned"));
  Surface surface = cube_and(on_tip({0.25f, 0.125f, 1}));
  for (int k = 0; k < 2; ++k) {  // whichever corner of its faces it is
    for (Face& face : surface.faces) face = {face[1], face[2], face[0]};
    CHECK(says(refusal(surface), "has 1 vertex and 0 edges"));
  }
}

TEST(AHairsBreadthBesideItIsNoTouch) {
  CHECK(refusal(cube_and(on_tip({0.25f, 0.125f, 1 + 0x1p-23f}))).empty());
  CHECK(refusal(cube_and(on_tip({1 + 0x1p-23f, 0.125f, 1}))).empty());
}

TEST(ACornerOnAFlatEdgeIsAsOnAFace) {  // the diagonal of the cube's top
  CHECK(says(refusal(cube_and(on_tip({0.25f, 0.25f, 1}))), "has 1 vertex and 0 edges"));
}

TEST(AConvexCornerOnAConvexEdgeIsHarmless) {
  CHECK(refusal(cube_and(on_tip({1, 0.25f, 1}))).empty());
}

TEST(ACornerOnAReflexEdgeIsRefused) {
  // A cube with a roof turned inward: the ridge from (-1, 0, 0) to (1, 0, 0).
  const Surface valley =
      numbered({{-1, -1, -1},
                {1, -1, -1},
                {1, 1, -1},
                {-1, 1, -1},
                {-1, -1, 1},
                {1, -1, 1},
                {1, 1, 1},
                {-1, 1, 1},
                {-1, 0, 0},
                {1, 0, 0}},
               faces_of("021 032 015 054 237 276 459 498 896 867 129 195 269 048 083 387"));
  CHECK(is_closed_and_alike(valley));
  Surface surface = valley;
  append(surface, spike({0.25f, 0, 0}, {0.1f, 0, 1}, {-0.1f, 0.1f, 1}, {-0.1f, -0.1f, 1}));
  CHECK(says(refusal(surface), "has 1 vertex and 0 edges"));
  CHECK(refusal(valley).empty());
}

TEST(AnEdgeOnAFaceIsRefusedAlsoWhereBothItsEndsAreElsewhere) {
  // Lying on the top and reaching beyond it on both sides, over convex edges alone: across one
  // corner.
  const Surface knife =
      spike({1.5f, -0.25f, 1}, {-1.75f, -1.75f, 0}, {0, 0, 1}, {-0.5f, -1.25f, 1});
  const std::string text = refusal(cube_and(knife));
  CHECK(says(text, "has 0 vertices and 1 edge"));
  CHECK(says(text, "the edge from vertex 8"));
}

TEST(AnEdgeThroughAFlatEdgeIsRefused) {  // upright through the diagonal of the cube's top
  const Surface through =
      spike({0.25f, 0.25f, 1.5f}, {0, 0, -1}, {0.25f, 0.125f, -0.375f}, {0.125f, 0.25f, -0.625f});
  CHECK(says(refusal(cube_and(through)), "has 0 vertices and 3 edges"));
}

TEST(ConvexEdgesThatCrossAreHarmless) {
  // An edge through (0.25, 1, 1), which slants away from the cube on both sides.
  const Surface hook = spike({0.25f, 1.5f, 0.5f}, {0, -1, 1}, {1, 0.5f, 1.5f}, {-1, 0.5f, 1.5f});
  CHECK(refusal(cube_and(hook)).empty());
}

TEST(FacesOnFacesOfOnePieceAreRefused) {
  CHECK(is_closed_and_alike(cut_ring(0)));
  CHECK(says(refusal(cut_ring(0)), "the sign is ambiguous there"));
  CHECK(refusal(cut_ring(-0.125f)).empty());
}

TEST(TouchesAreFoundAtEverySizeAndPlace) {
  for (const float scale : {0x1p-20f, 1.0f, 0x1p16f}) {
    Surface surface = cube_and(on_tip({0.25f, 0.125f, 1}));
    for (math::Vec3& v : surface.vertices)
      v = {v.x * scale + 2 * scale, v.y * scale, v.z * scale - 3 * scale};
    CHECK(says(refusal(surface), "has 1 vertex and 0 edges"));
  }
}

}  // namespace firmtouch::tools
