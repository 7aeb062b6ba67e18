#include "host_session.hpp"

#include "describe.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/link.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/link/build_id.hpp"
#include "firmtouch/link/handshake.hpp"
#include "firmtouch/link/text_writer.hpp"
#include "last_crash.hpp"
#include "saved_parameters.hpp"
#include "servo.hpp"
#include "servo_interrupt.hpp"

namespace firmtouch::app {
namespace {

// Measuring the painted stack reads all that was never used: thousands of words.
constexpr uint32_t kTicksPerStackLook = 64;

constexpr char kTooEarly[] = " before an accepted Hello of its mode";
constexpr char kOtherLength[] = " of another length: build both sides from the same release";

link::HelloReply describe() {
  link::HelloReply reply;
  reply.controller.asset_crc = controller.asset_crc();
  reply.controller.parameter_table_hash = params::table_hash(controller.kTable);
  reply.controller.build_id = link::build_id();
  reply.asset_rule = controller.verdict().rule;
  reply.asset_element = controller.verdict().element;
  reply.servo_period_us = servo_period_us();
  const char* name = hal::board_name();
  for (uint32_t i = 0; i < sizeof reply.board && name[i] != 0; ++i) reply.board[i] = name[i];
  return reply;
}

// A function of its own: its text is not on the stack of the paths that start something.
[[gnu::noinline]] void print_refusal(const link::Hello& hello, const link::HelloReply& reply) {
  char text[640];
  link::explain(hello.host, reply, text);
  hal::board_print(text);
}

}  // namespace

void HostSession::poll() {
  uint8_t bytes[64];
  link::Frame frame;
  // Replies are sent before requests are read: a host that does not read waits, and nothing is
  // lost.
  while (outbox_.has_room_to_stream()) {
    const uint32_t count = hal::link_read(bytes, sizeof bytes);
    if (count == 0) break;
    for (uint32_t i = 0; i < count; ++i) {
      decoder_.push(bytes[i]);
      while (decoder_.next(frame)) handle(frame);
    }
    outbox_.flush();
  }
  if (is_live()) {
    stream_records();
  } else {
    records.release(records.ready().size());  // no host: keep the latest records for the next one
  }
  outbox_.flush();
}

bool HostSession::is_idle() const {
  return outbox_.empty() && !(is_live() && records.waiting() > 0);
}

void HostSession::handle(const link::Frame& frame) {
  switch (frame.type) {
    case link::kHello:
      return answer_hello(frame);
    case link::kStep:
      return answer_step(frame);
    case link::kSetParam:
      return answer_set_param(frame);
    case link::kClearFaults:
      return answer_clear_faults(frame);
    case link::kSaveParameters:
      return answer_save(frame);
    case link::kPanel:
      return answer_panel(frame);
    case link::kStream:
      return answer_stream(frame);
    case link::kDescribe:
      return answer_describe(frame);
    case link::kBye:
      return leave(frame);
    default:
      if constexpr (kHasSlots || kKeepsCrash) {
        if (answer_optional(frame)) return;
      }
      return complain(frame, " is unknown: build both sides from the same release");
  }
}

// Result: false, with a complaint, where the message is not due or of another length.
template <class Message>
bool HostSession::take(const link::Frame& frame, bool is_due, Message& to) {
  const bool is_taken = is_due && link::take(frame, to);
  if (!is_taken) complain(frame, is_due ? kOtherLength : kTooEarly);
  return is_taken;
}

void HostSession::acknowledge(const link::Frame& frame, uint32_t index, uint32_t result) {
  outbox_.send(link::kAck, frame.sequence, link::bytes_of(link::Ack{index, result}));
}

void HostSession::answer_hello(const link::Frame& frame) {
  link::Hello hello;
  link::HelloReply reply = describe();
  if (link::take(frame, hello)) {
    reply.refused = reasons_to_refuse(hello, reply);
  } else {
    // Another version's Hello may be longer or shorter, but it begins with its version.
    const bool has_version = frame.payload.size() >= sizeof hello.host.protocol;
    if (has_version) {
      __builtin_memcpy(&hello.host.protocol, frame.payload.data(), sizeof hello.host.protocol);
    }
    if (!has_version || hello.host.protocol == link::kProtocolVersion) {
      return complain(frame, kOtherLength);
    }
    reply.refused = link::kRefusedProtocol;
  }

  phase_ = Phase::kStranger;
  if (reply.refused != 0) {
    const bool is_query =
        hello.mode == link::kModeIdentify || reply.refused == link::kRefusedNotReady;
    if (!is_query) print_refusal(hello, reply);
  } else if (hello.mode == link::kModeLockStep) {
    hal::motors_off();
    if constexpr (kHasSlots) asset_update.abort();
    controller.reset();
    has_stepped_ = false;
    phase_ = Phase::kLockStep;
  } else {
    start_servo();
    decimation_ = hello.decimation;
    phase_ = Phase::kLive;
  }
  outbox_.send(link::kHelloReply, frame.sequence, link::bytes_of(reply));
}

uint32_t HostSession::reasons_to_refuse(const link::Hello& hello,
                                        const link::HelloReply& reply) const {
  uint32_t refused = link::compare(hello.host, reply.controller);
  if (refused == link::kRefusedProtocol) return refused;
  if (!controller.is_ready()) {
    if (controller.verdict().ok()) return link::kRefusedNotReady;
    // The rule that rejected the asset says more than its CRC.
    refused = (refused & ~link::kRefusedAsset) | link::kRefusedAssetRejected;
  }
  if (hello.mode != link::kModeLive && hello.mode != link::kModeLockStep)
    refused |= link::kRefusedMode;
  if (hello.mode == link::kModeLockStep && servo_is_running()) refused |= link::kRefusedBusy;
  return refused;
}

void HostSession::answer_step(const link::Frame& frame) {
  link::Step step;
  if (!take(frame, is_lock_step(), step)) return;
  // The same step again: its reply was lost. The tick is not repeated.
  if (!has_stepped_ || step.input.tick != last_reply_.tick) {
    const uint32_t before = hal::clock_work();
    controller.tick(step.input, last_reply_.output);
    last_reply_.work = hal::clock_work() - before;
    controller.make_model();  // if this tick requested one
    last_reply_.work_per_1000 = hal::clock_work_per_1000();
    if (step.input.tick % kTicksPerStackLook == 0)
      last_reply_.stack_high_bytes = hal::board_stack_high_bytes();
    last_reply_.tick = step.input.tick;
    has_stepped_ = true;
  }
  outbox_.send(link::kStepReply, frame.sequence, link::bytes_of(last_reply_));
}

void HostSession::answer_set_param(const link::Frame& frame) {
  link::SetParam wanted;
  if (!take(frame, phase_ != Phase::kStranger, wanted)) return;
  uint32_t result = link::kAckTaken;
  if (is_lock_step()) {
    result = link::kAckInLockStep;
  } else if (wanted.index >= controller.kTable.size()) {
    result = link::kAckNoSuchParameter;
  } else {
    const params::Entry& row = controller.kTable[wanted.index];
    if (!(wanted.value >= row.low) || !(wanted.value <= row.high)) {
      result = link::kAckOutOfRange;
    } else if (!commands.put(wanted.index, wanted.value)) {
      result = link::kAckBusy;
    }
  }
  acknowledge(frame, wanted.index, result);
}

void HostSession::answer_clear_faults(const link::Frame& frame) {
  link::ClearFaults wanted;
  if (!take(frame, phase_ != Phase::kStranger, wanted)) return;
  uint32_t result = link::kAckTaken;
  if (is_lock_step()) {
    result = link::kAckInLockStep;
  } else if (!commands.put_clear_faults()) {
    result = link::kAckBusy;
  }
  acknowledge(frame, link::kAckOfClearFaults, result);
}

void HostSession::answer_save(const link::Frame& frame) {
  link::SaveParameters wanted;
  if (!take(frame, phase_ != Phase::kStranger, wanted)) return;
  acknowledge(frame, link::kAckOfSave, is_lock_step() ? link::kAckInLockStep : save_parameters());
}

void HostSession::answer_panel(const link::Frame& frame) {
  link::Panel panel;
  if (!take(frame, is_live(), panel)) return;
  set_panel(panel.flags);
  acknowledge(frame, link::kAckOfPanel);
}

void HostSession::answer_stream(const link::Frame& frame) {
  link::Stream wanted;
  if (!take(frame, is_live(), wanted)) return;
  decimation_ = wanted.decimation;
  acknowledge(frame, link::kAckOfStream);
}

void HostSession::answer_describe(const link::Frame& frame) {
  link::Describe wanted;
  if (!take(frame, true, wanted)) return;
  const link::Description row = describe_row(wanted);
  outbox_.send(link::kDescription, frame.sequence, link::bytes_of(row));
}

// Frames of parts that not every program has. Result: false if this one has it not.
bool HostSession::answer_optional(const link::Frame& frame) {
  if constexpr (kHasSlots) {
    link::AssetAck ack;
    if (asset_update.answer(frame, is_lock_step(), ack)) {
      outbox_.send(link::kAssetAck, frame.sequence, link::bytes_of(ack));
      return true;
    }
  }
  if constexpr (kKeepsCrash) {
    if (frame.type != link::kReadCrash) return false;
    outbox_.send(link::kCrashReply, frame.sequence, link::bytes_of(last_crash()));
    return true;
  }
  return false;
}

void HostSession::leave(const link::Frame& frame) {
  link::Bye bye;
  if (!take(frame, true, bye)) return;
  phase_ = Phase::kStranger;
  if (bye.what != link::kByeExit) return;
  if (!hal::board_may_exit()) return complain(frame, ": this board does not exit");
  hal::motors_off();
  outbox_.flush();
  hal::board_exit(0);
}

void HostSession::stream_records() {
  for (;;) {
    if (!outbox_.has_room_to_stream()) return;
    const core::Span<const record::Numbered<record::TickRecord>> ready = records.ready();
    if (ready.empty()) return;
    const bool is_wanted = decimation_ != 0 && ready[0].number % decimation_ == 0;
    link::Log log;
    if (is_wanted) {
      log.dropped = ready[0].number - records.consumed();
      log.record = ready[0];
    }
    records.release(1);
    if (is_wanted) outbox_.send(link::kLog, log_sequence_++, link::bytes_of(log));
  }
}

void HostSession::complain(const link::Frame& frame, const char* text) {
  char buffer[96];
  link::TextWriter(buffer).text("frame of type ").decimal(frame.type).text(text);
  outbox_.send_text(frame.sequence, buffer);
}

}  // namespace firmtouch::app
