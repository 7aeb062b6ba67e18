#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "firmtouch/record/tick.hpp"
#include "log/interface.hpp"

namespace firmtouch::host_sim {

/// Cost of a tick, as the controller reported it.
struct TickCost {
  uint32_t instructions = 0;      // of Controller::tick(); 0: not counted
  uint32_t stack_high_bytes = 0;  // highest stack use so far; 0: not measured
};

/// A controller outside this process, driven in lock-step: one input sent, one output received.
class LockStepController : public log::Interface {
 public:
  /// Throws Refused if the controller does not answer, or answers with an error.
  virtual TickCost tick(const record::TickInput& input, record::TickOutput& output) = 0;
  /// Name for messages and the report: "mps2-an500 (qemu)".
  virtual std::string name() const = 0;
};

/// Whether --controller names the controller in this process.
inline bool is_in_process(const std::string& controller) {
  return controller.empty() || controller == "inproc";
}

/// Opens the controller that --controller names: unix:PATH, tcp:HOST:PORT, qemu:BOARD or a serial
/// DEVICE; nullptr for inproc. `image`: the program for qemu:BOARD; empty: that of the board's own
/// build, with part `objects` if the asset has them. `asset_crc`: Controller::asset_crc(). Throws
/// Refused if it cannot be opened, does not answer within `wait_s`, or if asset, parameter table or
/// protocol differ.
std::unique_ptr<LockStepController> open_controller(const std::string& controller,
                                                    const std::string& image,
                                                    const std::string& asset_path,
                                                    uint32_t asset_crc, const std::string& program,
                                                    double wait_s);

}  // namespace firmtouch::host_sim
