#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "firmtouch/record/tick.hpp"

namespace firmtouch::host_sim {

/// One 4-byte word of a tick's record, under the name that a log's schema, a CSV's header and a
/// message give it.
struct Field {
  enum class Kind { kUnsigned, kSigned, kFloat };
  std::string name;  // "input.encoder_counts[1]"
  uint32_t offset;   // in TickRecord
  Kind kind;
};

/// Every word of TickRecord, in order, from record::kFields.
const std::vector<Field>& fields();

/// A field's value as text: floats with the digits that tell all of them apart.
std::string text_of(const Field& field, const record::TickRecord& record);

struct Difference {
  uint32_t tick = 0;
  std::string field;
  std::string expected, found;
};

/// The first word of the output that differs in any bit; those named in `without` are not compared.
/// Result: nothing where all are the same.
std::optional<Difference> first_difference(const record::TickRecord& expected,
                                           const record::TickOutput& found,
                                           const std::set<std::string>& without = {});

}  // namespace firmtouch::host_sim
