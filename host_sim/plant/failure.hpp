#pragma once
#include <cstdint>
#include <string>

namespace firmtouch::host_sim {

/// How a machine fails, from a tick on: one joint's encoder or motor, or what the hand holds.
enum class FailureMode : uint32_t {
  kEncoderStuck,     // counts no more
  kEncoderLost,      // reports invalid samples, and counts of 0
  kEncodersSwapped,  // with the next joint's
  kEncoderReversed,  // counts the other way, from where it is
  kEncoderSlipped,   // a belt's tooth off
  kMotorDead,
  kMotorReversed,
  kMotorHot,     // the driver reports it
  kLinkBroken,   // the hand holds a piece that came off
  kIndexAbsent,  // no index pulse comes
};
constexpr uint32_t kFailureModes = 10;

struct Failure {
  FailureMode mode = FailureMode::kEncoderStuck;
  uint32_t joint = 0;
};

/// "encoder_stuck"
const char* failure_name(FailureMode mode);
/// All of them: "encoder_stuck, encoder_lost, ...".
std::string failure_names();
/// Result: false if none has this name.
bool find_failure(const std::string& name, FailureMode& mode);

}  // namespace firmtouch::host_sim
