#include "registers.hpp"

// A serial flash with four data lines on the QSPI pins, read as memory from 0x90000000 on (RM0433,
// chapter 23). It must be programmed before, with its quad enable bit set. Read one word: an asset
// that is not there, or wired wrongly, is rejected when it is opened.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kQspi = 0x52005000;
constexpr uint32_t kQspiControl = kQspi + 0x00, kQspiDevice = kQspi + 0x04,
                   kQspiState = kQspi + 0x08, kQspiCommand = kQspi + 0x14;
constexpr uint32_t kRccMemories = kRcc + 0xD4, kQspiClock = 1u << 14;
constexpr uint32_t kOn = 1u << 0, kSampleLate = 1u << 4, kDivideBy4 = 3u << 24;  // 50 MHz
constexpr uint32_t kBytes_log2 = 23;                                             // as link_qspi.ld
constexpr uint32_t kBusy = 1u << 5;
// Fast read (0x6B): instruction and 24 bits of address on one line, 8 cycles, data on four lines.
constexpr uint32_t kReadAsMemory =
    0x6Bu | 1u << 8 | 1u << 10 | 2u << 12 | 8u << 18 | 3u << 24 | 3u << 26;
constexpr Pin kPins[] = {{kPortB, 2, 9},  {kPortB, 10, 9}, {kPortD, 11, 9},   // clock, select, 0
                         {kPortD, 12, 9}, {kPortE, 2, 9},  {kPortD, 13, 9}};  // 1, 2, 3

}  // namespace

void qspi_begin() {
  switch_on(kRccPorts, kPorts);
  switch_on(kRccMemories, kQspiClock);
  for (const Pin& pin : kPins) {
    constexpr uint32_t kPortSpeed = 0x08, kFast = 2;
    set_field(pin.port + kPortSpeed, 2 * pin.number, 2, kFast);
    pin_alternate(pin, Pull::kUp);
  }
  reg(kQspiDevice) = (kBytes_log2 - 1) << 16 | 3u << 8;  // four cycles between two reads
  reg(kQspiControl) = kDivideBy4 | kSampleLate | kOn;
  while ((reg(kQspiState) & kBusy) != 0) {
  }
  reg(kQspiCommand) = kReadAsMemory;
}

}  // namespace firmtouch::hal
