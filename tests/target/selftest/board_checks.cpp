#include "target/selftest/selftest.hpp"

// Board, parameters and slots for assets: before the servo runs, for an erase may stop the core.
namespace firmtouch::selftest {
namespace {

[[gnu::noinline]] uint32_t deep() {
  volatile uint8_t room[1024];
  for (uint32_t i = 0; i < sizeof room; ++i) room[i] = static_cast<uint8_t>(i);
  return room[hal::board_name()[0] & 0x7F];
}

core::Bytes part(core::Bytes of, uint32_t bytes) { return {of.data(), bytes}; }

bool is_all(core::Bytes bytes, uint8_t value) {
  for (uint32_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] != value) return false;
  return true;
}

struct FlashNames {
  const char *flash, *erase, *program;
};

/// Erases, programs and erases `sector` if it is blank: what a user keeps there stays.
template <class Erase, class Program>
void check_sector(const FlashNames& names, core::Bytes sector, Erase erase, Program program) {
  if (!is_all(part(sector, 64), 0xFF) && !is_all(part(sector, 64), 0))
    return skip(names.flash, "it holds data; erase the chip to check this flash");
  if (!check(names.erase, erase() && is_all(sector, 0xFF),
             "the sector is not all 0xFF: unlock, sector number, busy flag"))
    return;
  alignas(32) uint8_t bytes[32];
  for (uint32_t i = 0; i < 32; ++i) bytes[i] = static_cast<uint8_t>(0x5A + 37 * i);
  bool is_good = program(32, core::Bytes{bytes, 32}) && is_all(part(sector, 32), 0xFF) &&
                 is_all({sector.data() + 64, 32}, 0xFF);
  for (uint32_t i = 0; i < 32; ++i) is_good &= sector[32 + i] == bytes[i];
  check(names.program, is_good, "what is read differs: unlock, width of a write, a stale cache");
  erase();
}

void check_pair(const char* name, const core::Bytes (&two)[2]) {
  const bool is_aligned =
      (reinterpret_cast<uintptr_t>(two[0].data()) | reinterpret_cast<uintptr_t>(two[1].data())) %
          32 ==
      0;
  check(name, two[0].size() == two[1].size() && two[0].data() != two[1].data() && is_aligned,
        "two sectors of one size at multiples of 32 are needed");
}

void check_parameters() {
  const hal::ParameterFlash flash = hal::board_parameters();
  if (flash.sector[0].empty())
    return skip("board_parameters", "calibration is not kept (PARTS firmtouch_no_parameters)");
  check_pair("board_parameters", flash.sector);
  check_sector(
      {"board_parameters", "board_erase_parameters", "board_program_parameters"}, flash.sector[1],
      [] { return hal::board_erase_parameters(1); },
      [](uint32_t offset, core::Bytes bytes) {
        return hal::board_program_parameters(1, offset, bytes);
      });
}

#ifdef FIRMTOUCH_ASSET_SLOTS
void check_slots() {
  const hal::AssetSlots slots = hal::board_asset_slots();
  check_pair("board_asset_slots", slots.slot);
  if (slots.slot[1].size() < slots.sector_bytes) return;
  check_sector(
      {"board_asset_slots", "board_erase_asset", "board_program_asset"},
      part(slots.slot[1], slots.sector_bytes), [] { return hal::board_erase_asset(1, 0); },
      [](uint32_t offset, core::Bytes bytes) {
        return hal::board_program_asset(1, offset, bytes);
      });
}
#else
void check_slots() { skip("board_asset_slots", "this board has none"); }
#endif

}  // namespace

void check_board() {
  check("board_begin, board_print", true, "");  // you read it
  check("board_name", hal::board_name()[0] != 0, "it is empty");
  const core::Bytes asset = hal::board_asset();
  check("board_asset", !asset.empty() && reinterpret_cast<uintptr_t>(asset.data()) % 16 == 0,
        "it must lie at a multiple of 16: see ASSET and ASSET_SLOT in link.ld");
  check(
      "board_may_exit", !hal::board_may_exit(),
      "this image is for an emulator: on hardware its BKPT is a fault; link firmtouch_no_emulator");
  const uint32_t before_bytes = hal::board_stack_high_bytes();
  (void)deep();
  const uint32_t bytes = hal::board_stack_high_bytes();
  if (bytes == 0) return skip("board_stack_high_bytes", "this board does not paint its stack");
  check("board_stack_high_bytes", bytes >= 1024 && bytes >= before_bytes && bytes < 1u << 20,
        "it misses a call that used 1,024 bytes");
}

void check_flash() {
  check_parameters();
  check_slots();
}

}  // namespace firmtouch::selftest
