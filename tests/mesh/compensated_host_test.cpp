// The certificate against an attack: hill-climbing for the worst float32 loss, on triangles and
// queries where plain float32 is not enough.
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/compensated_distance.hpp"
#include "firmtouch/mesh/loss.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "harness/test.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

struct Case {
  Vec3 corner[3], p;
};

Vec3 moved(Vec3 v, Random& random, double by) {
  return {static_cast<float>(double{v.x} + random.between(-by, by)),
          static_cast<float>(double{v.y} + random.between(-by, by)),
          static_cast<float>(double{v.z} + random.between(-by, by))};
}

Case longest_first(const Case& c) {
  size_t first = 0;
  float longest2 = -1;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3 e = c.corner[(k + 1) % 3] - c.corner[k];
    if (math::dot(e, e) > longest2) longest2 = math::dot(e, e), first = k;
  }
  return {{c.corner[first], c.corner[(first + 1) % 3], c.corner[(first + 2) % 3]}, c.p};
}

double truth_of(const Case& c) {
  return true_distance(wide(c.p), wide(c.corner[0]), wide(c.corner[1]), wide(c.corner[2]));
}

// Hill climbing for the largest value of `loss` from many starts.
template <class LossOf>
double worst(LossOf loss, double reach, int starts, int steps) {
  Random random(17);
  double worst_of_all = -1;
  for (int s = 0; s < starts; ++s) {
    Case best{};
    for (Vec3& v : best.corner) v = moved({}, random, 1);
    best.p = moved({}, random, reach);
    best = longest_first(best);
    double best_loss = loss(best);
    double by = 0.1;
    for (int k = 0; k < steps; ++k) {
      Case next = best;
      next.p = moved(best.p, random, by);
      next.corner[random.below(3)] = moved(best.corner[random.below(3)], random, by);
      next = longest_first(next);
      const double now = loss(next);
      if (now > best_loss)
        best = next, best_loss = now;
      else if (k % 40 == 39)
        by *= 0.7;
    }
    worst_of_all = std::max(worst_of_all, best_loss);
  }
  return worst_of_all;
}

double longest(const Case& c) { return length(wide(c.corner[1]) - wide(c.corner[0])); }

mesh::Loss loss_of(const Case& c) {
  mesh::Head head{};
  head.longest_edge_m = static_cast<float>(longest(c));
  return mesh::Loss(head);
}

// Error of the plain solver as a share of what Loss allows it.
double plain_share(const Case& c) {
  if (!(longest(c) > 1e-3)) return -1;
  const double truth = truth_of(c);
  const mesh::Foot foot = mesh::closest_on_triangle(c.p, c.corner[0], c.corner[1], c.corner[2]);
  const double reported = std::sqrt(double{foot.distance2_m2});
  return std::fabs(reported - truth) / double{loss_of(c).plain_m(static_cast<float>(truth))};
}

double compensated_share(const Case& c) {
  if (!(longest(c) > 1e-3)) return -1;
  const double truth = truth_of(c);
  const float upper2 = mesh::compensated_distance2(c.p, c.corner[0], c.corner[1], c.corner[2]);
  return std::fabs(double{math::square_root(upper2)} - truth) /
         double{loss_of(c).compensated_m(static_cast<float>(truth))};
}

// Of the plain solver as a share of own_m(), by where the foot is; where the feature is clear, as
// only there it is less than plain_m().
double own_share(const Case& c) {
  const Vec3 ab = c.corner[1] - c.corner[0];
  if (!(longest(c) > 1e-3)) return -1;
  const mesh::Foot foot = mesh::closest_on_triangle(c.p, c.corner[0], c.corner[1], c.corner[2]);
  if (!mesh::is_feature_clear(foot.distance2_m2, ab)) return -1;
  const Vec3 from = foot.feature == mesh::Feature::kEdge1 ? c.corner[1] : c.corner[0];
  const float reach = math::length((c.p - from) - foot.offset_m);
  const double truth = truth_of(c), reported = std::sqrt(double{foot.distance2_m2});
  return std::fabs(reported - truth) /
         double{mesh::Loss::own_m(static_cast<float>(truth), math::dot(ab, ab), reach,
                                  foot.feature == mesh::Feature::kFace)};
}

double own_face_share(const Case& c) {
  const mesh::Foot foot = mesh::closest_on_triangle(c.p, c.corner[0], c.corner[1], c.corner[2]);
  return foot.feature == mesh::Feature::kFace ? own_share(c) : -1;
}

mesh::View one_triangle(const Case& c, std::vector<tools::Section>& sections) {
  tools::Surface surface;
  surface.vertices = {c.corner[0], c.corner[1], c.corner[2]};
  surface.faces = {{0, 1, 2}};
  tools::MeshOptions options;
  options.is_signed = false;
  tools::MeshReport report;
  sections = tools::bake_mesh(surface, "one", options, report);
  mesh::View view;
  if (report.problem.empty()) CHECK(tools::open_baked(sections, "one", view).ok());
  return view;
}

void check_certificate(const Case& c) {
  std::vector<tools::Section> sections;
  const mesh::View view = one_triangle(c, sections);
  if (!view.is_open()) return;
  mesh::Hint hint;
  const mesh::Closest answer = mesh::closest_point(view, c.p, query::kUnlimited, hint);
  const double truth = truth_of(c), scale = std::max(double{view.head().diagonal_m}, truth);
  CHECK(answer.certificate.exact);
  CHECK_LE(double{answer.certificate.lower_m}, truth);
  CHECK_LE(truth - double{answer.certificate.lower_m}, 4e-7 * scale);
  CHECK_LE(std::fabs(double{answer.distance_m} - truth), 4e-7 * scale);
}

}  // namespace

TEST(PlainLossStaysWithinItsBoundUnderAttack) {
  CHECK_LE(worst(plain_share, 1.5, 30, 1500), 1.0);
  CHECK_LE(worst(plain_share, 0.01, 30, 1500), 1.0);
  CHECK_LE(worst(plain_share, 30, 30, 1500), 1.0);
}

TEST(LossByTheFootStaysWithinItsBoundUnderAttack) {
  CHECK_LE(worst(own_share, 1.5, 30, 1500), 1.0);
  CHECK_LE(worst(own_share, 0.01, 30, 1500), 1.0);
  CHECK_LE(worst(own_share, 0.001, 30, 1500), 1.0);
  CHECK_GT(worst(own_share, 0.01, 30, 1500), 0.2);
  const double of_faces = worst(own_face_share, 0.003, 60, long_run() ? 30000 : 3000);
  CHECK_LE(of_faces, 1.0);
  CHECK_GT(of_faces, 0.3);
}

TEST(CompensatedLossStaysWithinItsBoundUnderAttack) {
  CHECK_LE(worst(compensated_share, 1.5, 20, 500), 1.0);
  CHECK_LE(worst(compensated_share, 0.01, 20, 500), 1.0);
  CHECK_LE(worst(compensated_share, 0.001, 20, 500), 1.0);
  CHECK_LE(worst(compensated_share, 30, 20, 500), 1.0);
}

// Found by hill-climbing: float32 alone returns 2.8e-7 of the distance too much here, so that a
// lower bound of 2e-7 below it was above the truth.
TEST(TheTriangleThatBrokeTheFirstCertificateHolds) {
  check_certificate({{{-0.811651766f, -0.379323512f, 0.00345657114f},
                      {-0.858275235f, 0.194350839f, -0.261579245f},
                      {-0.787006438f, -0.113617852f, -0.567302525f}},
                     {0.184121281f, -0.0459321588f, -0.0134678222f}});
}

TEST(CertificatesOfSingleTrianglesHold) {
  Random random(23);
  for (int i = 0; i < 3000; ++i) {
    test::note("case", i);
    Case c{};
    for (Vec3& v : c.corner) v = moved({}, random, 1);
    c.p = moved({}, random, std::pow(10.0, random.between(-3, 3)));
    check_certificate(c);
  }
}

// So thin that its pseudonormals, as they are stored, gave the wrong sign near its tip.
TEST(Needle_IsRejected) {
  tools::Surface needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}, {0.3f, 2e-4f, 5e-5f}, {0.31f, -1e-4f, 3e-4f}};
  needle.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  tools::MeshReport report;
  (void)tools::bake_mesh(needle, "needle", {}, report);
  CHECK(report.problem.find("needle") != std::string::npos);
}
