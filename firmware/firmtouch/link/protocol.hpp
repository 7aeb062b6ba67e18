#pragma once
#include <stdint.h>

#include "firmtouch/core/crash_record.hpp"
#include "firmtouch/link/frame.hpp"
#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"

// Messages of the link: the payload of each frame type, as plain structs without padding,
// little-endian. A host (simulator, live page) starts with Hello. Until the controller accepts it,
// it answers every other frame with Text, except Describe, ReadCrash and those that load an asset.
//
//   lock-step   Hello(kModeLockStep) -> HelloReply, then Step -> StepReply, one at a time, until
//               Bye. The host makes every tick: the timer does not run, the motors stay off. An
//               accepted Hello resets the controller. A repeated Step is answered again without a
//               second tick.
//   live        Hello(kModeLive) -> HelloReply. The timer makes the ticks. The controller sends a
//               Log frame for every n-th tick (Hello, Stream -> Ack). SetParam -> Ack, ClearFaults
//               -> Ack and Panel -> Ack are possible at any time, SaveParameters -> Ack while the
//               motors are off.
//   both        Describe -> Description: fields of a record, their bits, and parameters.
//               ReadCrash -> CrashReply: what the run before left. Both without Hello, too.
//   load        BeginAsset, then AssetBlock one at a time, then CommitAsset, each -> AssetAck. Not
//   in
//               lock-step. From BeginAsset to the end, or AbortAsset, the motors are held off.
//               CommitAsset is answered kAckBusy while the controller proves the asset: send again.
namespace firmtouch::link {

constexpr uint32_t kProtocolVersion = 7;

// Append-only. The high bit marks frames of the controller.
enum Type : uint8_t {
  kHello = 0x01,
  kStep = 0x02,
  kSetParam = 0x03,
  kBye = 0x04,
  kClearFaults = 0x05,
  kStream = 0x06,
  kDescribe = 0x07,
  kSaveParameters = 0x08,
  kPanel = 0x09,
  kReadCrash = 0x0A,  // of programs with part `crash_record`; others answer Text
  // Of programs with part `asset_slots`; others answer Text.
  kBeginAsset = 0x0B,
  kAssetBlock = 0x0C,
  kCommitAsset = 0x0D,
  kAbortAsset = 0x0E,
  kHelloReply = 0x81,
  kStepReply = 0x82,
  kAck = 0x83,
  kLog = 0x84,
  kText = 0x85,  // payload: UTF-8, no terminating zero
  kDescription = 0x86,
  kCrashReply = 0x87,
  kAssetAck = 0x88,
};

constexpr uint32_t kModeLive = 0;
constexpr uint32_t kModeLockStep = 1;
// Always rejected: the reply contains the controller's identity.
constexpr uint32_t kModeIdentify = UINT32_MAX;

/// Must be equal on both sides, so that both compute the same bits.
struct Identity {
  uint32_t protocol = kProtocolVersion;
  uint32_t asset_crc = 0;             // asset::Container::crc(); 0 if no asset is open
  uint64_t parameter_table_hash = 0;  // params::table_hash()
  uint64_t build_id = 0;              // link::build_id(): hash of the firmware's sources
};
static_assert(sizeof(Identity) == 24);

struct Hello {
  Identity host;
  uint32_t mode = kModeLive;
  uint32_t decimation = 1;  // live: as Stream::decimation
};
static_assert(sizeof(Hello) == 32);

// Bits of HelloReply::refused; 0 = accepted.
constexpr uint32_t kRefusedProtocol = 1u << 0;
constexpr uint32_t kRefusedAsset = 1u << 1;
constexpr uint32_t kRefusedParameterTable = 1u << 2;
constexpr uint32_t kRefusedBuild = 1u << 3;
constexpr uint32_t kRefusedMode = 1u << 4;           // unknown mode
constexpr uint32_t kRefusedAssetRejected = 1u << 5;  // by asset_rule
constexpr uint32_t kRefusedNotReady = 1u << 6;       // the asset is still being checked: try again
constexpr uint32_t kRefusedBusy = 1u << 7;           // lock-step: the servo's timer already runs

struct HelloReply {
  Identity controller;
  uint32_t refused = 0;
  uint32_t asset_rule = 0;     // 0, or the rule that rejected the asset (tools/FORMAT.md)
  uint32_t asset_element = 0;  // element at which that rule failed
  uint32_t servo_period_us = 0;
  char board[16] = {};  // zero-padded
};
static_assert(sizeof(HelloReply) == 56);

struct Step {
  record::TickInput input;
};
static_assert(sizeof(Step) == 36);

struct StepReply {
  uint32_t tick = 0;              // of the Step
  uint32_t work = 0;              // of Controller::tick(), in ticks of hal::clock_work()
  uint32_t work_per_1000 = 0;     // such ticks per 1,000 instructions; 0: the board cannot count
  uint32_t stack_high_bytes = 0;  // most stack in use, measured every 64 ticks; 0: not painted
  record::TickOutput output{};
};
static_assert(sizeof(StepReply) == 132);

struct SetParam {
  uint32_t index = 0;  // in the parameter table
  float value = 0;     // SI unit of that row
};
static_assert(sizeof(SetParam) == 8);

/// Payload of a request that its type alone states.
struct Empty {
  uint32_t reserved = 0;
};
static_assert(sizeof(Empty) == 4);

/// Clears the latched faults at the next tick if the enable switch is open then. That tick's record
/// has the result (record::kStateCommandTaken).
struct ClearFaults : Empty {};

/// Keeps the present parameters in flash. At the next start the first ticks set them by commands.
struct SaveParameters : Empty {};

// Ack::result
constexpr uint32_t kAckTaken = 0;
constexpr uint32_t kAckNoSuchParameter = 1;
constexpr uint32_t kAckOutOfRange = 2;
constexpr uint32_t kAckBusy = 3;         // the mailbox is full: send again
constexpr uint32_t kAckInLockStep = 4;   // rejected in lock-step: use TickInput::command of a Step
constexpr uint32_t kAckTimerRuns = 5;    // of older releases: tick_period_s could not change
constexpr uint32_t kAckNoFlash = 6;      // this board keeps no parameters
constexpr uint32_t kAckMotorsOn = 7;     // saving stops the processor: open the enable switch first
constexpr uint32_t kAckFlashFull = 8;    // restart the board: it erases flash only at start-up
constexpr uint32_t kAckFlashFailed = 9;  // what flash holds is not what was written
// Of AssetAck only.
constexpr uint32_t kAckNoUpdate = 10;       // begin first; what was loaded before is gone
constexpr uint32_t kAckAssetInTheWay = 11;  // the asset in use reaches into both slots
constexpr uint32_t kAckAssetRejected = 12;  // by a rule (tools/FORMAT.md): the old one stays in use
constexpr uint32_t kAckAtRestart = 13;      // taken; it cannot be touched before a restart
constexpr uint32_t kAckOtherProtocol = 14;
constexpr uint32_t kAckWrongCrc = 15;  // of all blocks together: load it again

// Ack::index of other requests than SetParam.
constexpr uint32_t kAckOfClearFaults = UINT32_MAX;
constexpr uint32_t kAckOfStream = UINT32_MAX - 1;
constexpr uint32_t kAckOfSave = UINT32_MAX - 2;
constexpr uint32_t kAckOfPanel = UINT32_MAX - 3;

struct Ack {
  uint32_t index = 0;
  uint32_t result = kAckTaken;
};
static_assert(sizeof(Ack) == 8);

/// Selects the records to send: those whose number is a multiple of `decimation`; 0: none.
/// A line of 1 Mbaud carries about 690 records a second; the rest is dropped and counted.
struct Stream {
  uint32_t decimation = 1;
};
static_assert(sizeof(Stream) == 4);

/// Buttons of the host. They can only take force away: the enable switch has the last word.
struct Panel {
  uint32_t flags = 0;  // kPanel... below
};
static_assert(sizeof(Panel) == 4);
// Enable is low until a Panel without this bit; the loss of the link changes nothing.
constexpr uint32_t kPanelDisable = 1u << 0;
constexpr uint32_t kPanelStop = 1u << 1;  // one tick with the emergency stop: a latched fault

/// One tick's record. If its number exceeds the last one's by more than the decimation, records are
/// missing; `dropped` shows how many of them the ring lost, the link lost the others.
struct Log {
  uint32_t dropped = 0;  // total before this record, because the ring was full
  record::Numbered<record::TickRecord> record;
};
static_assert(sizeof(Log) == 160);
static_assert(sizeof(Log) <= kMaxPayloadBytes);

// Describe::what
constexpr uint16_t kDescribeField = 0;      // record::kFields
constexpr uint16_t kDescribeBit = 1;        // record::kBits, then the faults
constexpr uint16_t kDescribeParameter = 2;  // params::kTable

struct Describe {
  uint16_t what = kDescribeField;
  uint16_t index = 0;
};
static_assert(sizeof(Describe) == 4);

/// One row. Texts are padded with zeros; a text of full length has no terminating zero.
struct Description {
  uint16_t what = 0;
  uint16_t index = 0;
  uint16_t rows = 0;     // of this table; if index >= rows, the rest is 0
  uint8_t kind = 0;      // field: record::Type; bit: its number; parameter: params::When
  uint8_t count = 0;     // field: values of four bytes
  float number[4] = {};  // field: scale, zero; parameter: low, high, initial, present value
  char name[32] = {};    // bit: its meaning
  char unit[24] = {};    // bit: the field that contains it
  char text[96] = {};    // explanation: effect of a parameter; cause of a fault and its parameter
};
static_assert(sizeof(Description) == 176);
static_assert(sizeof(Description) <= kMaxPayloadBytes);

struct ReadCrash : Empty {};

struct CrashReply {
  uint32_t is_left = 0;  // 0: nothing was; `record` says nothing then
  core::CrashRecord record;
};
static_assert(sizeof(CrashReply) == 152);
static_assert(sizeof(CrashReply) <= kMaxPayloadBytes);

struct BeginAsset {
  uint32_t protocol = kProtocolVersion;
  uint32_t bytes = 0;  // of the whole asset file
  uint32_t crc = 0;    // CRC-32 of these bytes
};
static_assert(sizeof(BeginAsset) == 12);

constexpr uint32_t kAssetBlockBytes = 224;
static_assert(kAssetBlockBytes % 32 == 0, "of flash words of up to 32 bytes");

/// In order. A block that the controller already has is acknowledged again.
struct AssetBlock {
  uint32_t offset = 0;                  // a multiple of kAssetBlockBytes
  uint8_t data[kAssetBlockBytes] = {};  // bytes behind the end of the asset are ignored
};
static_assert(sizeof(AssetBlock) <= kMaxPayloadBytes);

struct CommitAsset : Empty {};
struct AbortAsset : Empty {};

struct AssetAck {
  uint32_t result = kAckTaken;
  uint32_t next = 0;               // offset of the block to send
  uint32_t rule = 0, element = 0;  // of kAckAssetRejected
};
static_assert(sizeof(AssetAck) == 16);

// Bye::what
constexpr uint32_t kByeLeave = 0;  // the controller waits for the next Hello
constexpr uint32_t kByeExit = 1;   // hal::board_exit(): ends an emulator or process

struct Bye {
  uint32_t what = kByeLeave;
};
static_assert(sizeof(Bye) == 4);

}  // namespace firmtouch::link
