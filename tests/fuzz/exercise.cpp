#include <float.h>

#include <cstring>
#include <limits>
#include <memory>

#include "firmtouch/asset/loader.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/nearest_constraint.hpp"
#include "firmtouch/field/closest_point.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "fuzz/victim.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "simd/wide_mesh.hpp"

namespace firmtouch::fuzz {
namespace {

using math::Vec3;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr Vec3 kPoints[] = {
    {0.1f, 0.2f, 0.3f}, {1.0f, 0.7f, 0.5f}, {1.02f, 0.1f, -0.01f},     {40, -3, 7}, {kNan, 0, 0},
    {0, -kInfinite, 0}, {FLT_MAX, 1, 1},    {-1e30f, FLT_MAX, 1e-42f}, {0, 0, 0}};
constexpr uint32_t kBudgets[] = {1, 7, UINT32_MAX};
constexpr uint32_t kStepLimit = 4096;  // far above the nodes of the victim: an unlimited query ends

// Heap copies, each exactly as long as its section.
class Copies {
 public:
  core::Bytes of(core::Bytes bytes) {
    if (bytes.empty()) return {};
    blocks_.push_back(std::make_unique<uint8_t[]>(bytes.size()));
    std::memcpy(blocks_.back().get(), bytes.data(), bytes.size());
    return {blocks_.back().get(), bytes.size()};
  }
  template <class View, class... Others>
  core::Verdict open_geometry(const asset::Container& container, const char* name, View& view,
                              const Others&... others) {
    auto sections = asset::find_sections<typename View::Sections>(container, name);
    sections.each([&](uint32_t, core::Bytes& bytes) { bytes = of(bytes); });
    const core::Verdict verdict = open(sections, others..., view);
    CHECK_EQ(verdict.ok(), view.is_open());
    return verdict;
  }
  query::Probes probes(const asset::Container& container, const char* name, uint32_t type) {
    return query::read_probes(of(container.find(type, name)));
  }

 private:
  std::vector<std::unique_ptr<uint8_t[]>> blocks_;
};

bool is_finite(float value) { return value >= -FLT_MAX && value <= FLT_MAX; }
bool is_finite(Vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

void check_certificate(const query::Certificate& certificate, uint32_t budget, bool finite_point) {
  CHECK(is_finite(certificate.lower_m) && certificate.lower_m >= 0);
  CHECK_LE(certificate.steps, budget);
  CHECK_LE(certificate.steps, kStepLimit);
  CHECK(certificate.sign >= -1 && certificate.sign <= 1);
  CHECK(finite_point || !certificate.exact);
}

// Segments at one budget, `turn` modulo their number: a segment of such ends takes exact integers.
// All levels together try all budgets of every mesh, and eight bits of a byte all at every level.
void exercise_mesh(const simd::WideMesh& wide, uint32_t turn) {
  const mesh::View& view = wide.view();
  mesh::Hint warm;
  for (const uint32_t budget : kBudgets) {
    for (const Vec3 p : kPoints) {
      const mesh::Closest closest = wide.closest_point(p, {budget}, warm);
      CHECK(is_finite(closest.distance_m) && is_finite(closest.point_m) &&
            is_finite(closest.direction));
      CHECK_LT(closest.triangle, view.head().triangle_count);
      CHECK(closest.feature <= mesh::Feature::kVertex2);
      check_certificate(closest.certificate, budget, is_finite(p));
    }
    if (budget != kBudgets[turn % 3] && !test::is_long()) continue;
    for (uint32_t i = 0; i + 1 < sizeof(kPoints) / sizeof(kPoints[0]); ++i) {
      const mesh::Hit hit = wide.cast_segment(kPoints[i], kPoints[i + 1], {budget});
      CHECK(hit.t >= 0 && hit.t <= 1);
      CHECK_LT(hit.triangle, view.head().triangle_count);
      CHECK_LE(hit.steps, budget);
      CHECK_LE(hit.steps, kStepLimit);
    }
  }
}

void check_curve_answer(const curve::View& view, const curve::Closest& closest, uint32_t budget,
                        Vec3 p) {
  CHECK(is_finite(closest.distance_m) && is_finite(closest.point_m) && is_finite(closest.tangent));
  CHECK_LT(closest.segment, view.segment_count());
  CHECK(closest.arc >= 0 && closest.arc <= 1);
  check_certificate(closest.certificate, budget, is_finite(p));
}

void exercise_curve(const curve::View& view) {
  curve::Hint warm;
  curve::Neighbour memory[3];
  for (const uint32_t budget : kBudgets) {
    for (const Vec3 p : kPoints) {
      check_curve_answer(view, curve::closest_point(view, p, {budget}, warm), budget, p);
      const curve::Constraint tied = curve::nearest_constraint(
          view, p, {0.1f, 0.5f, true}, core::Span<curve::Neighbour>(memory), {budget});
      check_curve_answer(view, tied.closest, budget, p);
      CHECK(is_finite(tied.cost_m));
    }
  }
}

void exercise_field(const field::View& distance_field, const mesh::View& mesh) {
  mesh::Hint hint;
  for (const Vec3 p : kPoints) {
    const field::Bounds bounds = field::distance_bounds(distance_field, p);
    CHECK(is_finite(bounds.lower_m) && bounds.lower_m >= 0);
    CHECK(is_finite(bounds.upper_m) && bounds.upper_m >= bounds.lower_m);
    CHECK(bounds.sign >= -1 && bounds.sign <= 1);
    const field::Answer result = field::closest_point(distance_field, mesh, p, 0.1f, {7}, hint);
    check_certificate(result.closest.certificate, 7, is_finite(p));
    CHECK(is_finite(result.closest.distance_m));
  }
}

core::Verdict open_field(const asset::Container& container, const char* name,
                         const mesh::View& mesh) {
  Copies copies;
  if (container.find(field::kHeadSection, name).empty()) return core::kPassed;
  field::View view;
  const core::Verdict verdict = copies.open_geometry(container, name, view, mesh);
  if (verdict.ok()) exercise_field(view, mesh);
  return verdict;
}

core::Verdict open_mesh(const asset::Container& container, const char* name) {
  Copies copies;
  mesh::View view;
  const core::Verdict verdict = copies.open_geometry(container, name, view);
  if (!verdict.ok()) return verdict;
  static uint32_t turn = 0;
  for (const firmtouch_simd::Level& level : firmtouch_simd::levels())
    exercise_mesh(simd::WideMesh(view, level), turn++);  // sound trees that no baker makes, too
  ++turn;
  (void)mesh::probe_hash(view, copies.probes(container, name, mesh::kProbesSection).points);
  return open_field(container, name, view);
}

core::Verdict open_curve(const asset::Container& container, const char* name) {
  Copies copies;
  curve::View view;
  const core::Verdict verdict = copies.open_geometry(container, name, view);
  if (!verdict.ok()) return verdict;
  exercise_curve(view);
  (void)curve::probe_hash(view, copies.probes(container, name, curve::kProbesSection).points);
  return verdict;
}

}  // namespace

core::Verdict exercise(const std::vector<uint8_t>& file, const char* only) {
  asset::Container container;
  const core::Verdict verdict =
      asset::open({file.data(), static_cast<uint32_t>(file.size())}, container);
  if (!verdict.ok()) return verdict;
  core::Verdict first = core::kPassed;
  for (uint32_t i = 0; i < container.section_count(); ++i) {
    if (only != nullptr && std::strcmp(container.name(i), only) != 0) continue;
    core::Verdict found = core::kPassed;
    if (container.type(i) == mesh::kHeadSection) found = open_mesh(container, container.name(i));
    if (container.type(i) == curve::kHeadSection) found = open_curve(container, container.name(i));
    if (first.ok()) first = found;
  }
  return first;
}

}  // namespace firmtouch::fuzz
