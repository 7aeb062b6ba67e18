#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "firmtouch/record/tick.hpp"

namespace firmtouch::host_sim {

/// What a controller told beside the tick's output.
struct TickCost {
  uint32_t instructions = 0;      // of Controller::tick(); 0 where it cannot count
  uint32_t stack_high_bytes = 0;  // deepest so far; 0 where it does not tell
};

/// A controller at the far end of something, in lock-step: one tick in, one output back.
class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;
  /// Throws Refused where the controller no longer answers as it should.
  virtual TickCost tick(const record::TickInput& input, record::TickOutput& output) = 0;
  /// For messages and the report: "mps2-an500 (qemu)".
  virtual std::string name() const = 0;
};

/// Opens what --controller names: unix:PATH, tcp:HOST:PORT, qemu:BOARD or a serial DEVICE; nullptr
/// for inproc. `image`: the program for qemu:BOARD; empty: looked for beside this build.
/// `asset_crc`: Controller::asset_crc(). Throws Refused saying what is missing, or which of both
/// sides' versions differ.
std::unique_ptr<Port> open_port(const std::string& controller, const std::string& image,
                                const std::string& asset_path, uint32_t asset_crc);

}  // namespace firmtouch::host_sim
