#include "saved_parameters.hpp"

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/parameters.hpp"
#include "firmtouch/link/protocol.hpp"
#include "servo.hpp"
#include "servo_interrupt.hpp"

namespace firmtouch::app {

void prepare_saving() {
  for (uint32_t round = 0; round < 2; ++round) {  // both sectors, if neither holds a valid slot
    const hal::ParameterFlash flash = hal::board_parameters();
    if (flash.sector[0].empty()) return;
    const uint32_t sector = params::sector_to_erase(flash.sector);
    if (sector > 1) return;
    if (!hal::board_erase_parameters(sector))
      return hal::board_print("flash of the parameters cannot be erased: nothing will be saved\n");
  }
}

uint32_t save_parameters() {
  const hal::ParameterFlash flash = hal::board_parameters();
  if (flash.sector[0].empty()) return link::kAckNoFlash;
  if (motors_may_push()) return link::kAckMotorsOn;
  if (commands.has_waiting()) return link::kAckBusy;  // a value that no tick has set yet
  params::SavedSlot slot;
  if (!params::next_slot(flash.sector, slot)) return link::kAckFlashFull;
  params::Saved saved;
  params::save_into(saved, params::newest_saved(flash.sector), controller.kTable,
                    controller.values());
  const core::Bytes bytes{reinterpret_cast<const uint8_t*>(&saved), sizeof saved};
  const bool is_written = hal::board_program_parameters(slot.sector, slot.offset, bytes);
  const params::Saved* const newest = params::newest_saved(flash.sector);
  const bool is_there = newest != nullptr && newest->crc == saved.crc;
  return is_written && is_there ? link::kAckTaken : link::kAckFlashFailed;
}

void SavedCommands::begin() {
  const hal::ParameterFlash flash = hal::board_parameters();
  saved_ = flash.sector[0].empty() ? nullptr : params::newest_saved(flash.sector);
  is_same_table_ = saved_ != nullptr && saved_->table_hash == params::table_hash(controller.kTable);
  row_ = 0;
}

bool SavedCommands::take(record::TickInput& input) {
  if (saved_ == nullptr) return false;
  float value = 0;
  row_ = params::next_saved(*saved_, controller.kTable, is_same_table_, row_, value);
  if (row_ >= controller.kTable.size()) {
    saved_ = nullptr;
    return false;
  }
  input.command = ++row_;
  input.command_value = value;
  return true;
}

}  // namespace firmtouch::app
