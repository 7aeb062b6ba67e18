#include "host_sim/fields.hpp"

#include <cstdio>
#include <cstring>

namespace firmtouch::host_sim {
namespace {

struct Row {
  const char* name;
  Field::Kind kind;
  uint32_t count;
};

constexpr Field::Kind kU = Field::Kind::kUnsigned, kI = Field::Kind::kSigned,
                      kF = Field::Kind::kFloat;
constexpr Row kRows[] = {
    {"input.tick", kU, 1},
    {"input.clock_us", kU, 1},
    {"input.encoder_counts", kI, 3},
    {"input.lines", kU, 1},
    {"input.command", kU, 1},
    {"input.command_value", kF, 1},
    {"output.motor_N", kF, 3},
    {"output.position_m", kF, 3},
    {"output.velocity_mps", kF, 3},
    {"output.force_N", kF, 3},
    {"output.distance_m", kF, 1},
    {"output.distance_lower_m", kF, 1},
    {"output.penetration_m", kF, 1},
    {"output.guide_deviation_m", kF, 1},
    {"output.guide_arc", kF, 1},
    {"output.steps", kU, 1},
    {"output.faults", kU, 1},
    {"output.state", kU, 1},
    {"output.model_sequence", kU, 1},
};

constexpr uint32_t words_in_rows() {
  uint32_t words = 0;
  for (const Row& row : kRows) words += row.count;
  return words;
}
static_assert(words_in_rows() * 4 == sizeof(record::TickRecord),
              "a field of the record is missing here");

}  // namespace

const std::vector<Field>& fields() {
  static const std::vector<Field> all = [] {
    std::vector<Field> list;
    for (const Row& row : kRows)
      for (uint32_t k = 0; k < row.count; ++k) {
        const std::string index = row.count > 1 ? "[" + std::to_string(k) + "]" : "";
        list.push_back({row.name + index, static_cast<uint32_t>(list.size() * 4), row.kind});
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
                                           const record::TickOutput& found) {
  if (std::memcmp(&expected.output, &found, sizeof found) == 0) return {};
  const record::TickRecord other{expected.input, found};
  for (const Field& field : fields()) {
    const auto at = [&](const record::TickRecord& r) {
      return reinterpret_cast<const char*>(&r) + field.offset;
    };
    if (std::memcmp(at(expected), at(other), 4) == 0) continue;
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
