#include "firmtouch/field/view.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/field/centre.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/query/probe.hpp"

namespace firmtouch::field {
namespace {

using core::kPassed;
using core::reject;
using core::Verdict;

constexpr float kFarthest_m = 1e8f;  // a model ends at 1e7 m, its field not much later

using Stage = query::StageOf<Proof>;

}  // namespace

// A query from a right seed takes some thousand instructions; from a wrong one it may take all that
// a query of the mesh can.
const query::CheckStage Proof::kStages[1] = {
    Stage::of<&Proof::cell_count, &Proof::check_cell>(700)};

Verdict Proof::take(const Sections& s, const mesh::View& mesh) {
  mesh_ = &mesh;
  const core::Span<const Head> heads = core::as_whole_array<Head>(s.head);
  if (heads.size() != 1) return reject(kRuleHeadSize);
  const Head& head = heads[0];
  uint64_t cells = 1;
  for (uint32_t k = 0; k < 3; ++k) {
    if (head.count[k] == 0 || head.count[k] > kMaxCellsAnAxis) return reject(kRuleCellCount, k);
    cells *= head.count[k];
  }
  if (cells > kMaxCells) return reject(kRuleCellCount, 3);
  view.distances_ = core::as_whole_array<int16_t>(s.distances);
  if (view.distances_.size() != cells) return reject(kRuleDistancesSize, view.distances_.size());
  view.seeds_ = core::as_whole_array<uint32_t>(s.seeds);
  if (view.seeds_.size() != cells) return reject(kRuleSeedsSize, view.seeds_.size());
  if (!mesh.is_open()) return reject(kRuleMesh);
  view.head_ = &head;
  return kPassed;
}

Verdict Proof::check_head() const {
  const Head& head = view.head();
  const mesh::View& mesh = *mesh_;
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

Verdict Proof::check_cell(uint32_t i) {
  const Head& head = view.head();
  const int16_t word = view.distances_[i];
  if (word == kUnknown) return kPassed;
  const uint32_t x = i % head.count[0], yz = i / head.count[0];
  const math::Vec3 centre_m = centre_of(head, x, yz % head.count[1], yz / head.count[1]);
  mesh::Hint hint;
  hint.leaf_slot = view.seeds_[i];
  const mesh::Closest truth = mesh::closest_point(*mesh_, centre_m, query::kProbeBudget, hint);
  const float reported_m = truth.distance_m < 0.0f ? -truth.distance_m : truth.distance_m;
  const uint32_t quanta = quanta_of(word);
  const float lower_m = static_cast<float>(static_cast<int32_t>(quanta)) * head.quantum_m;
  const float upper_m = static_cast<float>(static_cast<int32_t>(quanta + kWide)) * head.quantum_m;
  const float max_m = reported_m + reported_slack_m(reported_m, mesh_->head().diagonal_m);
  if (!(lower_m <= truth.certificate.lower_m && upper_m >= max_m)) return reject(kRuleDistance, i);
  const int32_t side = word < 0 ? -1 : 1;
  if (!view.is_signed()) return word < 0 ? reject(kRuleDistance, i) : kPassed;
  return quanta == 0 || truth.certificate.sign == side ? kPassed : reject(kRuleDistance, i);
}

}  // namespace firmtouch::field

template class firmtouch::query::Opening<firmtouch::field::Proof>;
