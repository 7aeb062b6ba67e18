// Models at the ends of what is accepted: whatever passes reader, check and baker answers as brute
// force does, in double or better.
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "bake/mesh/bake_mesh.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"
#include "surface/write_surface.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

using Corners = std::array<Point, 8>;

Corners box(Point low, Point high) {
  Corners corners;
  for (size_t k = 0; k < 8; ++k) {
    corners[k] = {(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                  (k & 4) != 0 ? high.z : low.z};
  }
  return corners;
}

// As OBJ, so that the reader has its part; `first`: the vertices before these.
std::string obj_of(const Corners& corners, size_t first = 0) {
  std::string text;
  for (const Point& p : corners) {
    char line[120];
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
    text += line;
  }
  constexpr size_t kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& quad : kQuads) {
    text += "f";
    for (const size_t corner : quad) text += " " + std::to_string(first + corner + 1);
    text += "\n";
  }
  return text;
}

struct Model {
  tools::Surface surface;
  std::string problem;  // of reader, check or baker
  std::vector<tools::Section> sections;
  mesh::View view;
};

Model baked(const std::string& obj, double unit_m = 1, bool is_signed = true) {
  Model model;
  tools::Imported imported = tools::read_surface_bytes(obj, "hostile.obj", unit_m);
  model.problem = imported.problem;
  if (!model.problem.empty()) return model;
  model.surface = std::move(imported.surface);
  tools::CheckOptions checks;
  checks.allow_unsigned = !is_signed;
  for (const std::string& line : tools::check_and_mend(model.surface, checks).refused)
    model.problem += line;
  if (!model.problem.empty()) return model;
  tools::MeshOptions options;
  options.is_signed = is_signed;
  tools::MeshReport report;
  model.sections = tools::bake_mesh(model.surface, "hostile", options, report);
  model.problem = report.problem;
  if (model.problem.empty()) CHECK(tools::open_baked(model.sections, "hostile", model.view).ok());
  return model;
}

double truth_of(const tools::Surface& surface, Vec3 p) {
  double least = 1e300;
  for (const tools::Face& f : surface.faces) {
    least =
        std::min(least, true_distance(wide(p), wide(surface.vertices[f[0]]),
                                      wide(surface.vertices[f[1]]), wide(surface.vertices[f[2]])));
  }
  return least;
}

// `wrong_signs`: null, or where they are counted.
void check_query(const Model& model, double size, Vec3 p, mesh::Hint& warm, uint32_t* wrong_signs) {
  const double truth = truth_of(model.surface, p), scale = std::max(size, truth);
  const bool inside = brute_force(model.surface, wide(p)).inside;
  for (const uint32_t budget : {1u, 5u, 40u, UINT32_MAX, UINT32_MAX}) {
    mesh::Hint cold;
    mesh::Hint& hint = budget == UINT32_MAX ? warm : cold;
    const mesh::Closest c = mesh::closest_point(model.view, p, query::Budget{budget}, hint);
    const double reported = std::fabs(double{c.distance_m}), lower = double{c.certificate.lower_m};
    CHECK_LE(truth - reported, 4e-7 * scale);
    CHECK_LE(lower, truth + 1e-9 * scale);
    if (budget == UINT32_MAX && !c.certificate.exact) {
      // So near a mesh of few large triangles that float32 cannot decide the sign: reported, not
      // guessed.
      CHECK_EQ(c.certificate.sign, 0);
      CHECK_LE(truth, 6e-6 * size);
    }
    if (c.certificate.exact || budget == UINT32_MAX) {
      CHECK_LE(reported - truth, 4e-7 * scale);
      CHECK_LE(truth - lower, 4e-7 * scale);
    }
    if (!model.view.is_signed()) {
      CHECK_EQ(c.certificate.sign, 0);
    } else if (truth > 2e-6 * size && (c.certificate.exact || c.certificate.sign != 0)) {
      const int sign = inside ? -1 : 1;
      if (wrong_signs != nullptr && c.certificate.sign == -sign)
        ++*wrong_signs;
      else
        CHECK_EQ(c.certificate.sign, sign);
    }
  }
}

void answers_like_brute_force(const Model& model, size_t queries, uint32_t* wrong_signs = nullptr) {
  if (!model.problem.empty()) std::printf("  %s\n", model.problem.c_str());
  CHECK(model.problem.empty());
  if (!model.problem.empty()) return;
  const double size = diagonal(model.surface);
  mesh::Hint warm;
  size_t number = 0;
  for (const Vec3 p : hard_queries(model.surface, long_run() ? 20 * queries : queries, 5)) {
    test::note("query", static_cast<int64_t>(number++));
    check_query(model, size, p, warm, wrong_signs);
  }
}

std::string part_of(double scale, Point shift) {
  return tools::to_obj(moved(tools::make_part(4, 2000), scale, shift));
}

double extent(const tools::Surface& s) {
  float low = s.vertices[0].x, high = low;
  for (const Vec3& v : s.vertices) low = std::min(low, v.x), high = std::max(high, v.x);
  return double{high} - double{low};
}

}  // namespace

TEST(AMicrometreModelAnswersLikeBruteForce) {
  answers_like_brute_force(baked(obj_of(box({0, 0, 0}, {1e-6, 1e-6, 1e-6}))), 1000);
  answers_like_brute_force(baked(obj_of(box({0, 0, 0}, {1, 2, 3})), 1e-6), 1000);
  answers_like_brute_force(baked(part_of(1.1e-6 / extent(tools::make_part(4, 2000)), {})), 200);
}

TEST(AThousandKilometreModelAnswersLikeBruteForce) {
  answers_like_brute_force(baked(obj_of(box({-5e5, -5e5, -5e5}, {5e5, 5e5, 5e5}))), 1000);
  answers_like_brute_force(baked(part_of(0.9e6 / extent(tools::make_part(4, 2000)), {})), 200);
}

TEST(BeyondWhatIsRenderedIsRefusedWithTheSize) {
  for (const double size : {0.9e-6, 1.1e6, 1e-30, 1e30}) {
    const Model model = baked(obj_of(box({0, 0, 0}, {size, size, size})));
    CHECK(model.problem.find("large, beyond what is rendered") != std::string::npos ||
          model.problem.find("without area") != std::string::npos);
  }
}

TEST(FarFromTheOriginIsAnsweredLikeBruteForceOrRefused) {
  for (const Point& shift : {Point{1e4, 0, 0}, {-1e4, 1e4, 1e4}, {7e3, -7e3, 1}}) {
    answers_like_brute_force(baked(obj_of(box(shift, shift + Point{1, 1, 1}))), 1000);
    answers_like_brute_force(
        baked(obj_of(box(shift * 1e-5, shift * 1e-5 + Point{1e-5, 1e-5, 1e-5}))), 1000);
  }
  // A fine mesh has lost its shape there.
  const double size = extent(tools::make_part(4, 2000));
  const Model lost = baked(part_of(1, Point{1e4 * size, 0, 0}));
  CHECK(lost.problem.find("32-bit coordinates lose its shape there; move it to the origin") !=
        std::string::npos);
  answers_like_brute_force(baked(part_of(1, Point{30 * size, 9 * size, 0})), 200);
}

TEST(SliversOfTenMillionToOneAnswerLikeBruteForce) {
  // Of a hair opposite edges are equally far in float32: a few points get the sign of the other
  // one (mesh/README.md).
  uint32_t wrong = 0;
  answers_like_brute_force(baked(obj_of(box({0, 0, 0}, {1e-7, 1, 1e-7}))), 1000, &wrong);
  answers_like_brute_force(baked(obj_of(box({0, 0, 0}, {1e-4, 1e3, 2e-4}))), 1000, &wrong);
  CHECK_LE(wrong, long_run() ? 100u : 5u);  // of 200,000 answers and of 10,000
  // A cube whose top has a vertex a ten-millionth from an edge.
  std::string text = obj_of(box({0, 0, 0}, {1, 1, 1}));
  const std::string top = "f 5 6 8 7\n";
  text.replace(text.find(top), top.size(), "v 0.5 1e-7 1\nf 5 6 9\nf 6 8 9\nf 8 7 9\nf 7 5 9\n");
  answers_like_brute_force(baked(text), 1000);
  text.replace(text.find("1e-7 1\n"), 7, "3e-7 1.0000001\n");
  answers_like_brute_force(baked(text), 1000);
}

TEST(FoilsAndGapsOfAMillionthAnswerLikeBruteForceAndNarrowerAreRefused) {
  for (int k = 0; k < 4; ++k) {
    const double a = 0.9 * k, b = 1.7 * k;
    const auto turned = [&](Corners corners) {
      for (Point& p : corners) {
        p = {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
        p = {p.x * std::cos(b) - p.z * std::sin(b), p.y, p.x * std::sin(b) + p.z * std::cos(b)};
      }
      return corners;
    };
    const auto foil = [&](double thick) {
      return baked(obj_of(turned(box({0, 0, 0}, {1, 1, thick}))));
    };
    const auto apart = [&](double gap) {
      return baked(obj_of(turned(box({0, 0, 0}, {1, 1, 1}))) +
                   obj_of(turned(box({1 + gap, 0, 0}, {2, 1, 1})), 8));
    };
    answers_like_brute_force(foil(1.42e-6), 500);
    answers_like_brute_force(apart(2.45e-6), 500);
    for (const double part : {0.01, 0.05, 0.1, 0.2}) {
      CHECK(foil(part * 1.42e-6).problem.find("sign is ambiguous") != std::string::npos);
      CHECK(apart(part * 2.45e-6).problem.find("sign is ambiguous") != std::string::npos);
    }
  }
}

TEST(NestedShellsAnswerLikeBruteForce) {
  std::string text;
  for (size_t k = 0; k < 5; ++k) {
    const double half = 5 - static_cast<double>(k);
    text += obj_of(box({-half, -half, -half}, {half, half, half}), 8 * k);
  }
  answers_like_brute_force(baked(text), 3000);
}

TEST(SeveralComponentsAnswerLikeBruteForce) {
  std::string text;
  for (size_t k = 0; k < 27; ++k) {
    const Point low{static_cast<double>(k % 3) * 1.5, static_cast<double>(k / 3 % 3) * 1.25,
                    static_cast<double>(k / 9) * 1.001};
    text += obj_of(box(low, low + Point{1, 1, 1}), 8 * k);
  }
  answers_like_brute_force(baked(text), 3000);
}

TEST(BodiesThatTouchAtACornerAnswerLikeBruteForce) {
  answers_like_brute_force(
      baked(obj_of(box({0, 0, 0}, {1, 1, 1})) + obj_of(box({1, 1, 1}, {2, 2, 2}), 8)), 3000);
}

// One point of a pit, touched by the tip of another body: below it the nearest point belongs to
// both, and each would give another sign.
TEST(TipInThePitOfAnotherBody_IsRejected) {
  const std::string tip =
      "v 0 0 0\nv -0.2 -0.2 1\nv 0.2 -0.2 1\nv 0.2 0.2 1\nv -0.2 0.2 1\nf -4 -3 -2 -1\n"
      "f -5 -3 -4\nf -5 -2 -3\nf -5 -1 -2\nf -5 -4 -1\n";
  std::string pit = obj_of(box({-1, -1, -1}, {1, 1, 1}));
  const std::string top = "f 5 6 8 7\n";
  pit.replace(pit.find(top), top.size(), "v 0 0 0\nf 5 6 9\nf 6 8 9\nf 8 7 9\nf 7 5 9\n");
  std::string pit_after = obj_of(box({-1, -1, -1}, {1, 1, 1}), 5);
  const std::string top_after = "f 10 11 13 12\n";
  pit_after.replace(pit_after.find(top_after), top_after.size(),
                    "v 0 0 0\nf 10 11 14\nf 11 13 14\nf 13 12 14\nf 12 10 14\n");
  answers_like_brute_force(baked(pit), 2000);
  for (const std::string& order : {pit + tip, tip + pit_after}) {
    CHECK(baked(order).problem.find("in a pit or a notch") != std::string::npos);
  }
}

// Inside the upper box the nearest point lies on both, and the lower one would give outside.
TEST(FacesOnFaces_AreRejected) {
  const std::string lower = obj_of(box({0, 0, 0}, {1, 1, 1}));
  for (const Corners& upper : {box({0, 0, 1}, {1, 1, 2}), box({0.25, 0.25, 1}, {0.5, 0.75, 2}),
                               box({0.4, 0.3, 1}, {1.7, 1.6, 2})}) {
    CHECK(baked(lower + obj_of(upper, 8)).problem.find("on the face of another piece") !=
          std::string::npos);
  }
  answers_like_brute_force(baked(lower + obj_of(box({0, 0, 1.0001}, {1, 1, 2}), 8)), 1000);
}

TEST(OneTriangleIsRefusedOrAnswersUnsigned) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1e-3 1\nf 1 2 3\n";
  CHECK(baked(text).problem.find("3 open edges around 1 hole") != std::string::npos);
  answers_like_brute_force(baked(text, 1, false), 2000);
}

TEST(AMillionUnusedVerticesChangeNothing) {
  std::string text;
  for (int k = 0; k < 1000000; ++k) text += "v 1e9 -7 3.5e-7\n";
  const Model model = baked(text + obj_of(box({0, 0, 0}, {1, 1, 1}), 1000000));
  CHECK(model.problem.empty());
  CHECK_EQ(model.surface.vertices.size(), 8u);
  answers_like_brute_force(model, 200);
}
