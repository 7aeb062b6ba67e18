#pragma once
#include <stdint.h>

#include "asset_update.hpp"
#include "firmtouch/link/decoder.hpp"
#include "firmtouch/link/protocol.hpp"
#include "outbox.hpp"

namespace firmtouch::app {

/// The controller's side of link/protocol.hpp. Main loop only.
class HostSession {
 public:
  /// Reads and answers messages, streams records while the session is live, and writes to the link.
  void poll();

  bool is_live() const { return phase_ == Phase::kLive; }
  bool is_lock_step() const { return phase_ == Phase::kLockStep; }
  /// Nothing waits for the link: the main loop may sleep.
  bool is_idle() const;

 private:
  enum class Phase : uint8_t { kStranger, kLive, kLockStep };

  void handle(const link::Frame& frame);
  void answer_hello(const link::Frame& frame);
  uint32_t reasons_to_refuse(const link::Hello& hello, const link::HelloReply& reply) const;
  // A function of its own: tools/check/image leaves it out of the phases without lock-step.
  [[gnu::noinline]] void answer_step(const link::Frame& frame);
  void answer_set_param(const link::Frame& frame);
  void answer_clear_faults(const link::Frame& frame);
  [[gnu::noinline]] void answer_save(const link::Frame& frame);
  void answer_panel(const link::Frame& frame);
  void answer_stream(const link::Frame& frame);
  void answer_describe(const link::Frame& frame);
  bool answer_optional(const link::Frame& frame);
  void leave(const link::Frame& frame);
  void stream_records();
  template <class Message>
  bool take(const link::Frame& frame, bool is_due, Message& to);
  void acknowledge(const link::Frame& frame, uint32_t index, uint32_t result = link::kAckTaken);
  void complain(const link::Frame& frame, const char* text);

  link::Decoder decoder_;
  Outbox outbox_;
  Phase phase_ = Phase::kStranger;
  uint16_t log_sequence_ = 0;
  uint32_t decimation_ = 0;  // of the Hello; 0 at first, so that the object is all zeros
  bool has_stepped_ = false;
  link::StepReply last_reply_;
};

}  // namespace firmtouch::app
