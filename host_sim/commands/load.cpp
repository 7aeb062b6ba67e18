#include <chrono>
#include <iostream>
#include <thread>

#include "firmtouch/core/crc32.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/controllers/asset_remedy.hpp"
#include "host_sim/controllers/live_link.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

std::string problem_of(const link::AssetAck& ack) {
  switch (ack.result) {
    case link::kAckInLockStep:
      return "a host drives the controller in lock-step: let it leave first";
    case link::kAckOutOfRange:
      return "the asset does not fit the board's slot";
    case link::kAckMotorsOn:
      return "the motors are on: open the enable switch first";
    case link::kAckNoFlash:
      return "this board has no slots for assets";
    case link::kAckFlashFailed:
      return "what flash holds is not what was written; the old asset stays in use";
    case link::kAckNoUpdate:
      return "another host, or a restart, ended the update: load it again";
    case link::kAckAssetInTheWay:
      return "the asset in use reaches into both slots: flash a smaller one, or load with a "
             "debugger";
    case link::kAckAssetRejected:
      return "the controller rejects the asset by rule R" + std::to_string(ack.rule) +
             " at element " + std::to_string(ack.element) + ": " + asset_remedy(ack.rule) +
             ". The old one stays in use";
    case link::kAckOtherProtocol:
      return "the controller speaks another protocol: build both sides from the same release";
    case link::kAckWrongCrc:
      return "the bytes that came are not the file's: load it again";
    default:
      return "rejected with code " + std::to_string(ack.result);
  }
}

// Calls `request` again while the controller is busy with its asset.
template <class Request>
link::AssetAck answer_of(const Request& request) {
  for (;;) {
    const link::AssetAck ack = request();
    if (ack.result != link::kAckBusy) return ack;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

link::AssetAck load(LiveLink& controller, core::Bytes asset) {
  const std::function<void(double)> progress = progress_bar("load");
  const uint32_t crc = core::crc32(asset);
  link::AssetAck ack = answer_of([&] { return controller.begin_asset(asset.size(), crc); });
  while (ack.result == link::kAckTaken && ack.next < asset.size()) {
    if (progress) progress(static_cast<double>(ack.next) / asset.size());
    ack = controller.send_asset_block(asset, ack.next);
  }
  if (ack.result != link::kAckTaken) return ack;
  return answer_of([&] { return controller.commit_asset(); });
}

int load_asset(const cli::Arguments& options) {
  const std::string& path = options.positionals()[0];
  const AssetFile file(path);
  if (!options.has("--unchecked")) Session checked(path);
  LiveLink controller(connect_stream(options.positionals()[1], wait_s(options)));
  const link::AssetAck ack = load(controller, file.bytes());
  const bool is_loaded = ack.result == link::kAckTaken || ack.result == link::kAckAtRestart;
  std::cerr << path << ": "
            << (ack.result == link::kAckTaken ? "loaded, proven and in use"
                : is_loaded                   ? "loaded and proven; in use after a restart"
                                              : problem_of(ack))
            << "\n";
  return is_loaded ? 0 : 1;
}

}  // namespace

cli::Command load_command() {
  return {
      {"load", "ASSET.fta CONTROLLER [options]", 2, 2, load_asset},
      "loads an asset into a running controller, which proves it, keeps it and swaps to it",
      R"(CONTROLLER: unix:PATH, tcp:HOST:PORT or a serial DEVICE (1 Mbaud). Its program needs part
`asset_slots` (hal/PORTING.md). The motors must be off, and stay off until the asset is in
use; then open the enable switch once. A power cut leaves the old asset or the new one.
Exit codes: 0 loaded; 1 the controller refused it, and keeps the old one.)",
      {{"--unchecked", nullptr, "send the file as it is: the controller alone proves it"},
       wait_option()}};
}

}  // namespace firmtouch::host_sim
