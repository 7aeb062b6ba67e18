#pragma once
#include <string>
#include <vector>

#include "host_sim/bench/rig.hpp"

namespace firmtouch::host_sim {

/// A figure beside its closed form, if it has one, and its bar: met if value <= bar.
struct ContactRow {
  std::string what;
  double value;
  std::string unit;
  double bar;
  std::string remark;  // the closed form
  double share() const { return bar > 0 ? value / bar : value; }
};

/// Rows of a rig. The same rows in the same order for every rig and either contact.
std::vector<ContactRow> resting_rows(const Rig& rig, Contact contact);
std::vector<ContactRow> onset_rows(const Rig& rig, Contact contact);
/// `is_long`: all pairs of thickness and radius; else some.
std::vector<ContactRow> plate_rows(const Rig& rig, Contact contact, bool is_long);

/// A point slides over a coarse ball: how the force turns, without force shading and with it.
std::vector<ContactRow> shading_rows(const Rig& rig);

/// Adds what closed loops of a hand over objects of different stiffness give and take.
void add_material_rows(bool is_long, bench::Report& report);

}  // namespace firmtouch::host_sim
