// A log in which the asset is swapped is replayed by `firmtouch-sim replay --next-asset`.
#include <string>

#include "firmtouch/params/table.hpp"
#include "harness/test.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/part_asset.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

std::string hex(uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "%llx", static_cast<unsigned long long>(value));
  return text;
}

// A hand that sinks by 20 um a tick onto the part; in tick 700 the part gets a lid.
std::string swapped_log() {
  Session session(test::part_asset());
  session.load_next(test::two_part_asset());
  const Tick tick = session.tick();
  Log log;
  log.text["asset"] = test::part_asset();
  log.text["asset_crc"] = hex(session.controller->asset_crc());
  log.text["parameter_table"] = hex(params::table_hash());
  for (uint32_t i = 0; i < 1500; ++i) {
    record::TickRecord now{};
    now.input.tick = i;
    now.input.clock_us = i * 1000;
    now.input.encoder_counts[0] = 1500;
    now.input.encoder_counts[2] = 2000 - static_cast<int32_t>(2 * i);
    now.input.flags = i > 10 ? record::kFlagEnable : 0;
    if (i == 700) now.input.command = record::kCommandSwapAsset;
    tick(now.input, now.output);
    log.records.push_back(now);
  }
  CHECK((log.records[700].output.state & record::kStateCommandTaken) != 0);
  const std::string path = test::scratch() + "/swapped.ftl";
  write_log(path, log);
  return path;
}

TEST(Replay_OfALogWithASwap_NeedsTheNextAssetAndGivesEveryBit) {
  const std::string path = swapped_log();
  const auto replayed = [](const std::vector<std::string>& words) {
    const cli::Command command = replay_command();
    return command.run(cli::Arguments(command, words));
  };
  CHECK_EQ(replayed({path, "--next-asset", test::two_part_asset()}), 0);
  CHECK_EQ(replayed({path, "--next-asset", test::part_asset()}), 1);
  std::string refusal;
  try {
    replayed({path});
  } catch (const Refused& refused) {
    refusal = refused.what();
  }
  CHECK(refusal.find("tick 700 swaps the asset") != std::string::npos);
}

}  // namespace
}  // namespace firmtouch::host_sim
