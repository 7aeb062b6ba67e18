#include <iostream>

#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/logged_session.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/controllers/lock_step_controller.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/report/page_data.hpp"
#include "host_sim/trace/replay.hpp"

namespace firmtouch::host_sim {
namespace {

// A replay starts with a fresh controller, so it needs every tick from the first one on.
void check_complete(const std::string& path, const Log& log) {
  if (log.records.empty())
    throw Refused(path + ": it contains no tick" + (log.damage.empty() ? "" : ": " + log.damage));
  if (log.decimation != 1)
    throw Refused(path + ": it contains every " + std::to_string(log.decimation) +
                  "th tick only; record with --decimate 1 to replay");
  if (log.first_number != 0)
    throw Refused(path + ": it begins at record " + std::to_string(log.first_number) +
                  "; a replay needs all ticks from 0 on: replay the log that it was cut from");
}

// Ticks, whether all bits are equal, and the first difference.
std::string json_of(const std::string& path, const Log& log, const std::string& by,
                    const std::optional<Difference>& d) {
  std::string text = "{\"log\": " + json_text(path) +
                     ", \"ticks\": " + std::to_string(log.records.size()) +
                     ", \"controller\": " + json_text(by) +
                     ", \"is_complete\": " + (log.is_complete ? "true" : "false") +
                     ", \"is_equal\": " + (d ? "false" : "true");
  if (d)
    text += ", \"difference\": {\"tick\": " + std::to_string(d->tick) +
            ", \"field\": " + json_text(d->field) + ", \"recorded\": " + json_text(d->expected) +
            ", \"replayed\": " + json_text(d->found) + "}";
  return text + "}\n";
}

// Loads the asset that the log swaps to.
void load_next(const cli::Arguments& options, const std::string& path, const Log& log,
               Session& session) {
  const std::string next = options.text("--next-asset");
  if (!next.empty()) {
    if (!is_in_process(options.text("--controller")))
      options.refuse("--next-asset is for the controller in this process");
    return session.load_next(next);
  }
  for (const record::TickRecord& one : log.records)
    if (one.input.command == record::kCommandSwapAsset &&
        (one.output.state & record::kStateCommandTaken) != 0)
      throw Refused(path + ": tick " + std::to_string(one.input.tick) +
                    " swaps the asset; give the one that follows with --next-asset");
}

int replay_log(const cli::Arguments& options) {
  const std::string path = options.positionals()[0];
  const Log log = read_log(path);
  const std::unique_ptr<Session> opened = session_of(path, log, options.text("--asset"));
  Session& session = *opened;
  check_complete(path, log);
  load_next(options, path, log, session);
  if (!log.is_complete)
    std::cerr << path << ": " << log.damage << "; the " << log.records.size()
              << " ticks before them are replayed\n";
  for (const std::string& name : log.missing_outputs)
    std::cerr << path << ": it has no field " << name << "; that field is not compared\n";
  check_scene(session, options.text("--controller"));
  const std::unique_ptr<LockStepController> port =
      open_controller(options.text("--controller"), options.text("--image"), session.asset.path(),
                      session.controller->asset_crc(), session.program(), wait_s(options));
  const std::string by = port ? port->name() : "in-process";
  const Tick remote = [&](const record::TickInput& input, record::TickOutput& output) {
    port->tick(input, output);
  };
  const std::optional<Difference> d =
      replay(log, port ? remote : session.tick(), progress_bar("replaying"));
  if (options.has("--json")) std::cout << json_of(path, log, by, d);
  if (d) {
    std::cerr << "firmtouch-sim: " << path << ": first difference at tick " << d->tick << " in "
              << d->field << ": recorded " << d->expected << ", replayed (" << by << ") "
              << d->found << "\n";
    return 1;
  }
  if (!options.has("--json"))
    std::cout << path << ": " << log.records.size() << " ticks replayed (" << by
              << "), every output bit the same\n";
  return log.is_complete ? 0 : 1;
}

}  // namespace

cli::Command replay_command() {
  return {{"replay", "LOG [options]", 1, 1, replay_log},
          "recomputes a log from its inputs and compares every bit of every output",
          R"(Exit codes: 0 all outputs are equal; 1 an output differs (its tick and field are
printed), or the log is incomplete and all outputs before the gap are equal.)",
          {{"--asset", "FILE", "the asset, if it is not at the path in the log"},
           {"--next-asset", "FILE", "the asset that a tick of the log swaps to"},
           {"--controller", "WHAT",
            "inproc (default), qemu:BOARD, unix:PATH, tcp:HOST:PORT or a serial DEVICE"},
           {"--image", "FILE",
            "the program for qemu:BOARD (default: build/BOARD/bin/firmtouch_app.elf)"},
           wait_option(),
           {"--json", nullptr, "the answer as JSON on stdout"}}};
}

}  // namespace firmtouch::host_sim
