#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "firmtouch/record/tick.hpp"

namespace firmtouch::host_sim {

/// One 4-byte word of a tick's record, with its name in logs, CSV headers and messages.
struct Field {
  enum class Kind { kUnsigned, kSigned, kFloat };
  std::string name;  // "input.encoder_counts[1]"
  uint32_t offset;   // in TickRecord
  Kind kind;
};

/// Every word of TickRecord, in order, from record::kFields.
const std::vector<Field>& fields();

/// A field's value as text; floats with nine digits, so that different values print differently.
std::string text_of(const Field& field, const record::TickRecord& record);

struct Difference {
  uint32_t tick = 0;
  std::string field;
  std::string expected, found;
};

/// The first word of the output that differs in any bit; fields in `missing_outputs` are skipped.
/// Result: nullopt if all are equal.
std::optional<Difference> first_difference(const record::TickRecord& expected,
                                           const record::TickOutput& found,
                                           const std::set<std::string>& missing_outputs = {});

}  // namespace firmtouch::host_sim
