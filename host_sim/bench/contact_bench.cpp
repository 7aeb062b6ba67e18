#include "host_sim/bench/benches.hpp"
#include "host_sim/bench/contact_rows.hpp"

namespace firmtouch::host_sim {
namespace {

std::vector<ContactRow> all_rows(const Rig& rig, Contact contact, bool is_long) {
  std::vector<ContactRow> rows = resting_rows(rig, contact);
  for (const ContactRow& row : onset_rows(rig, contact)) rows.push_back(row);
  for (const ContactRow& row : plate_rows(rig, contact, is_long)) rows.push_back(row);
  return rows;
}

void add_bars(const std::vector<ContactRow>& rows, const std::string& of, bench::Report& report) {
  for (const ContactRow& row : rows)
    report.bar(row.what, of, row.value, row.unit, row.bar, row.remark);
}

}  // namespace

// Contact of the standard rig (host_sim/bench/rig.hpp) with solids whose contact has a closed form:
// upright, and turned with other sizes, the worst row of all. The same rows of penalty contact show
// that they can fail.
void run_contact_bench(const bench::Options& options, bench::Report& report) {
  report.stage("upright");
  const Rig upright(0);
  add_bars(all_rows(upright, Contact::kProxy, options.is_long), "upright", report);
  add_bars(shading_rows(upright), "upright", report);
  const uint64_t seeds = options.is_long ? 50 : 10;
  std::vector<ContactRow> worst;
  for (uint64_t seed = 1; seed <= seeds; ++seed) {
    report.stage("turned: " + std::to_string(seed) + " of " + std::to_string(seeds));
    std::vector<ContactRow> rows = all_rows(Rig(seed), Contact::kProxy, options.is_long);
    if (worst.empty()) worst = rows;
    for (size_t i = 0; i < rows.size(); ++i) {
      rows[i].remark += (rows[i].remark.empty() ? "seed " : "; seed ") + std::to_string(seed);
      if (!(rows[i].share() <= worst[i].share()) || seed == 1) worst[i] = rows[i];
    }
  }
  add_bars(worst, "turned", report);
  report.stage("penalty contact");
  double failing = 0;
  for (const ContactRow& row : all_rows(upright, Contact::kPenalty, options.is_long)) {
    report.figure(row.what, "penalty", row.value, row.unit, row.remark);
    failing += !(row.value <= row.bar);
  }
  report.bar_at_least("rows that penalty contact fails", "penalty", failing, "", 8);
}

}  // namespace firmtouch::host_sim
