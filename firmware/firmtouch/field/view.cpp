#include "firmtouch/field/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/field/centre.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::field {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

constexpr float kFarthest_m = 1e8f;  // a model ends at 1e7 m, its field not much later

Verdict check_head(const Head& head, const mesh::View& mesh) {
  for (const uint32_t word : head.reserved)
    if (word != 0) return reject(kRuleReserved);
  if (head.is_signed > 1 || (head.is_signed == 1) != mesh.is_signed()) return reject(kRuleMesh);
  for (uint32_t k = 0; k < 3; ++k)
    if (!(head.low_m[k] >= -kFarthest_m && head.low_m[k] <= kFarthest_m))
      return reject(kRuleGrid, k);
  if (!(head.cell_m >= 1e-12f && head.cell_m <= kFarthest_m)) return reject(kRuleCell);
  if (!query::is_power_of_two(head.quantum_m)) return reject(kRuleQuantum);
  for (uint32_t k = 0; k < 3; ++k)
    if (!(head.low_m[k] <= mesh.head().low_m[k] && high_on_axis(head, k) >= mesh.head().high_m[k]))
      return reject(kRuleGrid, k);
  return kPassed;
}

}  // namespace

const query::CheckStage<Opening> Opening::kStages[1] = {
    {&Opening::cell_count, &Opening::check_cell}};

Opening::Opening(const Sections& sections, const mesh::View& mesh) : mesh_(&mesh) {
  check_.begin(open_head(sections));
}

void Opening::work(uint32_t cells) { check_.work(*this, kStages, cells); }

Verdict Opening::open_head(const Sections& s) {
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return reject(kRuleHeadSize);
  const Head& head = heads[0];
  uint64_t cells = 1;
  for (uint32_t k = 0; k < 3; ++k) {
    if (head.count[k] == 0 || head.count[k] > kMaxCellsAnAxis) return reject(kRuleCellCount, k);
    cells *= head.count[k];
  }
  if (cells > kMaxCells) return reject(kRuleCellCount, 3);
  view_.distances_ = core::as_whole_array<int16_t>(s.distances);
  if (view_.distances_.size() != cells) return reject(kRuleDistancesSize, view_.distances_.size());
  view_.seeds_ = core::as_whole_array<uint32_t>(s.seeds);
  if (view_.seeds_.size() != cells) return reject(kRuleSeedsSize, view_.seeds_.size());
  if (!mesh_->is_open()) return reject(kRuleMesh);
  view_.head_ = &head;
  return check_head(head, *mesh_);
}

Verdict Opening::check_cell(uint32_t i) {
  const Head& head = view_.head();
  const int16_t word = view_.distances_[i];
  if (word == kUnknown) return kPassed;
  const uint32_t x = i % head.count[0], yz = i / head.count[0];
  const math::Vec3 centre_m = centre_of(head, x, yz % head.count[1], yz / head.count[1]);
  mesh::Hint hint;
  hint.leaf_slot = view_.seeds_[i];
  const mesh::Closest truth = mesh::closest_point(*mesh_, centre_m, query::kUnlimited, hint);
  const float reported_m = truth.distance_m < 0.0f ? -truth.distance_m : truth.distance_m;
  const uint32_t quanta = quanta_of(word);
  const float lower_m = static_cast<float>(static_cast<int32_t>(quanta)) * head.quantum_m;
  const float upper_m = static_cast<float>(static_cast<int32_t>(quanta + kWide)) * head.quantum_m;
  const float max_m = reported_m + reported_slack_m(reported_m, mesh_->head().diagonal_m);
  if (!(lower_m <= truth.certificate.lower_m && upper_m >= max_m)) return reject(kRuleDistance, i);
  const int32_t side = word < 0 ? -1 : 1;
  if (!view_.is_signed()) return word < 0 ? reject(kRuleDistance, i) : kPassed;
  return quanta == 0 || truth.certificate.sign == side ? kPassed : reject(kRuleDistance, i);
}

Verdict open(const Sections& sections, const mesh::View& mesh, View& view) {
  Opening opening(sections, mesh);
  return query::open_at_once(opening, view);
}

}  // namespace firmtouch::field
