#include "host_sim/trace/fields.hpp"

#include <cstdio>
#include <cstring>

#include "firmtouch/record/schema.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr Field::Kind kKinds[record::kTypeCount] = {Field::Kind::kUnsigned, Field::Kind::kSigned,
                                                    Field::Kind::kFloat};

}  // namespace

const std::vector<Field>& fields() {
  static const std::vector<Field> all = [] {
    std::vector<Field> list;
    for (const record::Field& row : record::kFields) {
      if (row.name == std::string("number")) continue;  // belongs to the ring, not to the tick
      for (uint32_t k = 0; k < row.count; ++k) {
        const std::string index = row.count > 1 ? "[" + std::to_string(k) + "]" : "";
        list.push_back({row.name + index, static_cast<uint32_t>(list.size() * 4),
                        kKinds[static_cast<uint32_t>(row.type)]});
      }
    }
    return list;
  }();
  return all;
}

std::string text_of(const Field& field, const record::TickRecord& record) {
  uint32_t word;
  std::memcpy(&word, reinterpret_cast<const char*>(&record) + field.offset, sizeof word);
  if (field.kind == Field::Kind::kUnsigned) return std::to_string(word);
  if (field.kind == Field::Kind::kSigned) {
    int32_t value;
    std::memcpy(&value, &word, sizeof value);
    return std::to_string(value);
  }
  float value;
  std::memcpy(&value, &word, sizeof value);
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
  return text;
}

std::optional<Difference> first_difference(const record::TickRecord& expected,
                                           const record::TickOutput& found,
                                           const std::set<std::string>& missing_outputs) {
  if (std::memcmp(&expected.output, &found, sizeof found) == 0) return {};
  const record::TickRecord other{expected.input, found};
  for (const Field& field : fields()) {
    const auto at = [&](const record::TickRecord& r) {
      return reinterpret_cast<const char*>(&r) + field.offset;
    };
    if (std::memcmp(at(expected), at(other), 4) == 0 || missing_outputs.count(field.name) != 0)
      continue;
    uint32_t bits[2];
    std::memcpy(&bits[0], at(expected), 4);
    std::memcpy(&bits[1], at(other), 4);
    char hex[2][16];
    for (int k = 0; k < 2; ++k) std::snprintf(hex[k], sizeof hex[k], " (0x%08x)", bits[k]);
    return Difference{expected.input.tick, field.name, text_of(field, expected) + hex[0],
                      text_of(field, other) + hex[1]};
  }
  return {};
}

}  // namespace firmtouch::host_sim
