#include "firmtouch/record/schema.hpp"

namespace firmtouch::record {

extern constexpr Field kFields[kFieldCount] = {
    {"number", "1", 1, 0, Type::kU32, 1},
    {"input.tick", "1", 1, 0, Type::kU32, 1},
    {"input.clock_us", "s", 1e-6f, 0, Type::kU32, 1},
    {"input.encoder_counts", "1", 1, 0, Type::kI32, kAxes},
    {"input.lines", "bits", 1, 0, Type::kU32, 1},
    {"input.command", "1", 1, 0, Type::kU32, 1},
    {"input.command_value", "1", 1, 0, Type::kF32, 1},
    {"input.last_work_us", "s", 1e-6f, 0, Type::kU32, 1},
    {"output.motor_N", "N", 1, 0, Type::kF32, kAxes},
    {"output.position_m", "m", 1, 0, Type::kF32, kAxes},
    {"output.velocity_mps", "m/s", 1, 0, Type::kF32, kAxes},
    {"output.force_N", "N", 1, 0, Type::kF32, kAxes},
    {"output.distance_m", "m", 1, 0, Type::kF32, 1},
    {"output.distance_lower_m", "m", 1, 0, Type::kF32, 1},
    {"output.penetration_m", "m", 1, 0, Type::kF32, 1},
    {"output.guide_deviation_m", "m", 1, 0, Type::kF32, 1},
    {"output.guide_lower_m", "m", 1, 0, Type::kF32, 1},
    {"output.guide_arc", "1", 1, 0, Type::kF32, 1},
    {"output.steps", "1", 1, 0, Type::kU32, 1},
    {"output.guide_steps", "1", 1, 0, Type::kU32, 1},
    {"output.faults", "bits", 1, 0, Type::kU32, 1},
    {"output.state", "bits", 1, 0, Type::kU32, 1},
    {"output.model_sequence", "1", 1, 0, Type::kU32, 1},
    {"output.proxy_m", "m", 1, 0, Type::kF32, kAxes},
    {"output.torque_Nm", "N*m", 1, 0, Type::kF32, kAxes},
};

extern constexpr Bit kBits[kBitCount] = {
    {"input.lines", "enable", 0},
    {"input.lines", "emergency stop", 1},
    {"input.lines", "drive fault", 2},
    {"input.lines", "encoder fault", 3},
    {"input.lines", "model apart", 4},
    {"input.lines", "model taken", 5},
    {"input.lines", "model wanted", 6},
    {"output.state", "contact", 8},
    {"output.state", "on guide", 9},
    {"output.state", "exact", 10},
    {"output.state", "command taken", 11},
    {"output.state", "command refused", 12},
    {"output.state", "ready", 13},
    {"output.state", "guide exact", 14},
    {"output.state", "base hull", 15},
    {"output.state", "proxy", 18},
    {"output.state", "contact uncertain", 19},
    {"output.state", "not homed", 20},
    {"output.state", "homing", 21},
};

namespace {

constexpr uint32_t words_of_fields() {
  uint32_t words = 0;
  for (const Field& field : kFields) words += field.count;
  return words;
}
static_assert(words_of_fields() * 4 == sizeof(Numbered<TickRecord>),
              "a field of the record has no row, or a row no field");
static_assert(kFlagEncoderFault == 1u << 3 && kFlagModelWanted == 1u << 6 &&
                  kStateContact == 1u << 8 && kStateGuideExact == 1u << 14 &&
                  kStateOfBaseHull == 1u << 15 && kStateProxy == 1u << 18 &&
                  kStateUncertain == 1u << 19 && kStateHoming == 1u << 21,
              "the bits are those of tick.hpp");

}  // namespace
}  // namespace firmtouch::record
