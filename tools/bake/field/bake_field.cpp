#include "bake/field/bake_field.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/field/centre.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/query/probe.hpp"

namespace firmtouch::tools {
namespace {

field::Head make_head(const mesh::View& mesh, uint32_t long_axis) {
  const mesh::Head& of = mesh.head();
  field::Head head{};
  float extent_m = 0;
  for (int k = 0; k < 3; ++k) extent_m = std::max(extent_m, of.high_m[k] - of.low_m[k]);
  head.is_signed = mesh.is_signed() ? 1 : 0;
  head.cell_m = extent_m / static_cast<float>(long_axis);
  for (int k = 0; k < 3; ++k) {
    const double side = static_cast<double>(of.high_m[k]) - static_cast<double>(of.low_m[k]);
    const double cell = static_cast<double>(head.cell_m);
    const double inner = std::max(std::ceil(side / cell - 1e-6), 1.0);
    head.count[k] = static_cast<uint32_t>(inner) + 2;
    head.low_m[k] = static_cast<float>(static_cast<double>(of.low_m[k]) -
                                       (static_cast<double>(head.count[k]) * cell - side) / 2);
  }
  return head;
}

struct Cell {
  float lower_m, reported_m;
  int8_t sign;
};

}  // namespace

std::vector<Section> bake_field(const mesh::View& mesh, const std::string& name, uint32_t long_axis,
                                FieldReport& report) {
  field::Head head = make_head(mesh, long_axis);
  const uint64_t count = uint64_t{head.count[0]} * head.count[1] * head.count[2];
  if (*std::max_element(head.count, head.count + 3) > field::kMaxCellsAnAxis ||
      count > field::kMaxCells) {
    report.problem = "a distance field of " + std::to_string(long_axis) + " cells would have " +
                     std::to_string(count) + ", more than the " + std::to_string(field::kMaxCells) +
                     " that fit; choose fewer";
    return {};
  }
  std::vector<Cell> cells;
  std::vector<uint32_t> seeds;
  mesh::Hint hint;
  float farthest_m = 0;
  for (uint32_t z = 0; z < head.count[2]; ++z)
    for (uint32_t y = 0; y < head.count[1]; ++y)
      for (uint32_t x = 0; x < head.count[0]; ++x) {
        const math::Vec3 centre_m = field::centre_of(head, x, y, z);
        (void)mesh::closest_point(mesh, centre_m, query::kUnlimited, hint);
        mesh::Hint from_seed;  // as the proof queries
        from_seed.leaf_slot = hint.leaf_slot;
        const mesh::Closest c = mesh::closest_point(mesh, centre_m, query::kProbeBudget, from_seed);
        cells.push_back({c.certificate.lower_m, std::fabs(c.distance_m), c.certificate.sign});
        seeds.push_back(hint.leaf_slot);
        farthest_m = std::max(farthest_m, c.certificate.lower_m);
      }
  head.quantum_m = 0x1p-90f;
  while (farthest_m > head.quantum_m * static_cast<float>(field::kMaxQuanta)) head.quantum_m *= 2;
  std::vector<int16_t> words;
  for (const Cell& cell : cells) {
    const uint32_t quanta = static_cast<uint32_t>(cell.lower_m / head.quantum_m);
    const float max_m =
        cell.reported_m + field::reported_slack_m(cell.reported_m, mesh.head().diagonal_m);
    const bool fits = max_m <= static_cast<float>(quanta + field::kWide) * head.quantum_m &&
                      (cell.sign != 0 || quanta == 0 || !mesh.is_signed());
    const int32_t word =
        cell.sign < 0 ? -1 - static_cast<int32_t>(quanta) : static_cast<int32_t>(quanta);
    words.push_back(fits ? static_cast<int16_t>(word) : field::kUnknown);
    report.unknown += fits ? 0 : 1;
  }
  std::vector<Section> sections{make_section(field::kHeadSection, name, &head, 1),
                                make_section(field::kDistancesSection, name, words),
                                make_section(field::kSeedsSection, name, seeds)};
  for (const Section& s : sections) report.bytes += static_cast<uint32_t>(s.bytes.size());
  for (int k = 0; k < 3; ++k) report.count[k] = head.count[k];
  report.cell_m = static_cast<double>(head.cell_m);
  report.quantum_m = static_cast<double>(head.quantum_m);
  field::View view;
  const core::Verdict verdict =
      field::open(sections_of<field::Sections>(sections, name), mesh, view);
  if (!verdict.ok()) {
    report.problem = "the distance field fails its own proof, rule R" +
                     std::to_string(verdict.rule) + " at element " +
                     std::to_string(verdict.element) + "; please report this model";
    return {};
  }
  return sections;
}

}  // namespace firmtouch::tools
