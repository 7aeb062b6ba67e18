#pragma once
#include <stdint.h>

#include "firmtouch/link/frame.hpp"
#include "firmtouch/record/tick.hpp"

// What is said over the link: the payload of each frame type, plain structs without padding,
// little-endian. A host (simulator, live page) begins with Hello; until it is accepted every other
// frame is answered by Text.
//
//   lock-step   Hello(kModeLockStep) -> HelloReply, then Step -> StepReply, one at a time, until
//               Bye. Every tick is the host's: the timer does not run, the motors stay off. An
//               accepted Hello resets the controller; a Step that comes twice is answered twice,
//               but ticked once.
//   live        Hello(kModeLive) -> HelloReply. Ticks are the timer's; their Log frames flow, and
//               SetParam -> Ack, ClearFaults -> Ack.
namespace firmtouch::link {

constexpr uint32_t kProtocolVersion = 2;

// Append-only. The high bit marks what the controller says.
enum Type : uint8_t {
  kHello = 0x01,
  kStep = 0x02,
  kSetParam = 0x03,
  kBye = 0x04,
  kClearFaults = 0x05,
  kHelloReply = 0x81,
  kStepReply = 0x82,
  kAck = 0x83,
  kLog = 0x84,
  kText = 0x85,  // payload: UTF-8, no terminating zero
};

constexpr uint32_t kModeLive = 0;
constexpr uint32_t kModeLockStep = 1;

/// What must be the same on both sides, or the figures of one are not those of the other.
struct Identity {
  uint32_t protocol = kProtocolVersion;
  uint32_t asset_crc = 0;             // asset::Container::crc(); 0 where no asset is open
  uint64_t parameter_table_hash = 0;  // params::table_hash()
  uint64_t build_id = 0;              // link::build_id(): hash of the firmware's sources
};
static_assert(sizeof(Identity) == 24);

struct Hello {
  Identity host;
  uint32_t mode = kModeLive;
  uint32_t reserved = 0;
};
static_assert(sizeof(Hello) == 32);

// Bits of HelloReply::refused; 0 = accepted.
constexpr uint32_t kRefusedProtocol = 1u << 0;
constexpr uint32_t kRefusedAsset = 1u << 1;
constexpr uint32_t kRefusedParameterTable = 1u << 2;
constexpr uint32_t kRefusedBuild = 1u << 3;
constexpr uint32_t kRefusedMode = 1u << 4;           // a mode that this controller does not know
constexpr uint32_t kRefusedAssetRejected = 1u << 5;  // by asset_rule: bake it again
constexpr uint32_t kRefusedNotReady = 1u << 6;       // the asset is still being opened: ask again
constexpr uint32_t kRefusedBusy = 1u << 7;           // lock-step: the servo's timer runs already

struct HelloReply {
  Identity controller;
  uint32_t refused = 0;
  uint32_t asset_rule = 0;     // 0, or the numbered rule that rejected the asset (tools/FORMAT.md)
  uint32_t asset_element = 0;  // where that rule failed
  uint32_t servo_period_us = 0;
  char board[16] = {};  // zero-padded
};
static_assert(sizeof(HelloReply) == 56);

struct Step {
  record::TickInput input;
};
static_assert(sizeof(Step) == 32);

struct StepReply {
  uint32_t tick = 0;              // of the Step that this answers
  uint32_t work = 0;              // hal::clock_work() ticks that Controller::tick() took
  uint32_t work_per_1000 = 0;     // such ticks per 1,000 instructions; 0: the board cannot count
  uint32_t stack_high_bytes = 0;  // deepest stack, looked at every 64 ticks; 0: not painted
  record::TickOutput output{};
};
static_assert(sizeof(StepReply) == 100);

struct SetParam {
  uint32_t index = 0;  // in the parameter table
  float value = 0;     // SI unit of that row
};
static_assert(sizeof(SetParam) == 8);

/// Forgets the latched faults at the next tick, if the enable switch is open then; the record of that
/// tick says whether (record::kStateCommandTaken).
struct ClearFaults {
  uint32_t reserved = 0;
};
static_assert(sizeof(ClearFaults) == 4);

// Ack::result
constexpr uint32_t kAckTaken = 0;
constexpr uint32_t kAckNoSuchParameter = 1;
constexpr uint32_t kAckOutOfRange = 2;
constexpr uint32_t kAckBusy = 3;  // the command before it has not reached its tick: send again
constexpr uint32_t kAckInLockStep = 4;  // there a command travels in its Step: TickInput::command
constexpr uint32_t kAckTimerRuns = 5;   // tick_period_s: the board's timer keeps its own

constexpr uint32_t kAckOfClearFaults = UINT32_MAX;  // Ack::index, where no parameter was meant

struct Ack {
  uint32_t index = 0;
  uint32_t result = kAckTaken;
};
static_assert(sizeof(Ack) == 8);

/// One tick's record; produced = consumed + dropped holds between any two of them.
struct Log {
  uint32_t number = 0;   // of this record among those kept, from 0
  uint32_t dropped = 0;  // records lost before this one, in all
  record::TickRecord record{};
};
static_assert(sizeof(Log) == 124);
static_assert(sizeof(Log) <= kMaxPayloadBytes);

// Bye::what
constexpr uint32_t kByeLeave = 0;  // the controller waits for the next Hello
constexpr uint32_t kByeExit = 1;   // hal::board_exit(): an emulator's or process's end

struct Bye {
  uint32_t what = kByeLeave;
};
static_assert(sizeof(Bye) == 4);

}  // namespace firmtouch::link
