#include <cstdio>
#include <iostream>

#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/controllers/live_link.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

using core::CrashCause;
using core::CrashRecord;

std::string hex(uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08x", value);
  return text;
}

// Configurable Fault Status Register of a Cortex-M (ARM DDI 0403, B3.2.15).
struct StatusBit {
  uint32_t bit;
  const char* text;
};
constexpr StatusBit kStatusBits[] = {
    {0, "an instruction was fetched from forbidden memory"},
    {1, "data was accessed in forbidden memory"},
    {3, "forbidden memory at the return from an interrupt"},
    {4, "forbidden memory at an interrupt: its stack"},
    {5, "forbidden memory while floating-point state was saved"},
    {8, "bus error of an instruction fetch"},
    {9, "bus error of a data access"},
    {10, "bus error of an earlier write"},
    {11, "bus error at the return from an interrupt"},
    {12, "bus error at an interrupt: its stack"},
    {13, "bus error while floating-point state was saved"},
    {16, "undefined instruction"},
    {17, "invalid instruction set state"},
    {18, "invalid return from an interrupt"},
    {19, "no coprocessor: the floating-point unit is off"},
    {20, "stack overflow at its limit register"},
    {24, "unaligned access"},
    {25, "division by zero"},
};

std::string what_of(const CrashRecord& record) {
  switch (record.cause) {
    case CrashCause::kFault:
      break;
    case CrashCause::kStackOverflow:
      return "a stack overflow";
    case CrashCause::kWatchdog:
      return "the watchdog";
    default:
      return "a reset without a noted fault";
  }
  std::string text = "a fault";
  for (const StatusBit& row : kStatusBits)
    if ((record.status >> row.bit & 1) != 0) text += std::string("; ") + row.text;
  return text;
}

std::string state_of(const log::Header& names, uint32_t state) {
  const char* const modes[] = {"off", "ramp in", "on", "ramp out", "fault"};  // servo::Mode
  const uint32_t mode = state & record::kStateServoMask;
  const std::string bits = names.names("output.state", state & 0xFFFCFF00u);
  return std::string(mode < 5 ? modes[mode] : "?") + (bits.empty() ? "" : "|") + bits;
}

const char* remedy_of(CrashCause cause) {
  switch (cause) {
    case CrashCause::kFault:
      return "mend what stands at pc; lr is its caller, or what ran before";
    case CrashCause::kStackOverflow:
      return "raise STACK_BYTES in the board's linker script; tools/check/image prints the worst "
             "stack";
    case CrashCause::kWatchdog:
      return "pc is what ran when it expired: look for an endless loop there, in the main loop or "
             "in the servo interrupt";
    default:
      return "check supply, reset pin and debugger, and a watchdog that resets without a warning";
  }
}

void print(const CrashRecord& record, const log::Header& names, const std::string& image) {
  std::cout << "The last run was ended by " << what_of(record) << ".\n";
  if (record.pc != 0) {
    std::cout << "where:      pc " << hex(record.pc) << ", lr " << hex(record.link) << ", status "
              << hex(record.status) << "\n            arm-none-eabi-addr2line -pfiCe " << image
              << " " << hex(record.pc) << " " << hex(record.link) << "\n";
  }
  std::cout << "last ticks: " << (record.ticks == 0 ? "none was kept\n" : "oldest first\n");
  for (uint32_t i = 0; i < record.ticks && i < core::kCrashTicks; ++i) {
    const core::CrashTick& tick = record.last[i];
    std::cout << "  tick " << tick.tick << ", clock_us " << tick.clock_us << ", state "
              << hex(tick.state) << " (" << state_of(names, tick.state) << "), faults "
              << hex(tick.faults) << " ("
              << (tick.faults == 0 ? "none" : names.names("output.faults", tick.faults)) << ")\n";
  }
  std::cout << "how to go on: " << remedy_of(record.cause) << ".\n";
}

void print_json(const link::CrashReply& reply) {
  const CrashRecord& record = reply.record;
  std::cout << "{\"left\": " << (reply.is_left != 0 ? "true" : "false")
            << ", \"cause\": " << static_cast<uint32_t>(record.cause) << ", \"pc\": " << record.pc
            << ", \"lr\": " << record.link << ", \"status\": " << record.status << ", \"ticks\": [";
  for (uint32_t i = 0; i < record.ticks && i < core::kCrashTicks; ++i) {
    const core::CrashTick& tick = record.last[i];
    std::cout << (i == 0 ? "" : ", ") << "[" << tick.tick << ", " << tick.clock_us << ", "
              << tick.state << ", " << tick.faults << "]";
  }
  std::cout << "]}\n";
}

int read_crash(const cli::Arguments& options) {
  const std::string image = options.text("--image");
  LiveLink controller(connect_stream(options.positionals()[0], wait_s(options)));
  const link::CrashReply reply = controller.read_crash();
  if (options.has("--json")) {
    print_json(reply);
  } else if (reply.is_left == 0) {
    std::cout << "The last run left nothing: the board was without power before this one.\n";
  } else {
    controller.describe();
    print(reply.record, controller.header(), image.empty() ? "PROGRAM.elf" : image);
  }
  return reply.is_left != 0 ? 0 : 1;
}

}  // namespace

cli::Command crash_command() {
  return {
      {"crash", "CONTROLLER [options]", 1, 1, read_crash},
      "prints what ended a controller's last run: cause, place, last ticks, and how to go on",
      R"(CONTROLLER: unix:PATH, tcp:HOST:PORT or a serial DEVICE (1 Mbaud). Its program needs part
`crash_record` (hal/PORTING.md); firmtouch_app_hardware of a Cortex-M has it.
Exit codes: 0 a record was printed; 1 the last run left none.)",
      {{"--image", "FILE.elf", "the program that ran then, for the command that finds the place"},
       wait_option(),
       {"--json", nullptr, "numbers instead of text"}}};
}

}  // namespace firmtouch::host_sim
