#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/controllers/asset_file.hpp"
#include "host_sim/controllers/live_link.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/report/page_data.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/log.hpp"
#include "host_sim/trace/queued_records.hpp"
#include "log/recorder.hpp"

namespace firmtouch::host_sim {
namespace {

volatile std::sig_atomic_t g_stop = 0;
void on_signal(int) { g_stop = 1; }

std::string hex(uint64_t value, int digits) {
  char text[24];
  std::snprintf(text, sizeof text, "%0*llx", digits, static_cast<unsigned long long>(value));
  return text;
}

std::string number_text(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
  return text;
}

struct ParameterRequest {
  uint32_t index;
  float value;
  std::string name;
};

std::vector<ParameterRequest> parameter_requests(const cli::Arguments& options,
                                                 const LiveLink& controller) {
  std::vector<ParameterRequest> requests;
  for (const std::string& set : options.texts("--set")) {
    const size_t equals = set.find('=');
    if (equals == std::string::npos) cli::fail_usage("--set " + set + ": write --set NAME=VALUE");
    const std::string name = set.substr(0, equals);
    char* end = nullptr;
    const float value = std::strtof(set.c_str() + equals + 1, &end);
    if (*end != 0 || end == set.c_str() + equals + 1)
      cli::fail_usage("--set " + set + ": write a number after the =");
    uint32_t index = 0;
    while (index < controller.parameters().size() &&
           text_in(controller.parameters()[index].name) != name)
      ++index;
    if (index == controller.parameters().size())
      cli::fail_usage("--set " + set + ": the controller has no parameter " + name);
    requests.push_back({index, value, name});
  }
  return requests;
}

log::Header header_of(const LiveLink& controller, uint32_t decimation, const std::string& asset,
                      const std::string& log_path) {
  log::Header header = controller.header();
  header.decimation = decimation;
  const link::HelloReply& reply = controller.reply();
  if (!asset.empty()) header.text["asset"] = path_from(log_path, asset);
  header.text["asset_crc"] = hex(reply.controller.asset_crc, 8);
  header.text["parameter_table"] = hex(reply.controller.parameter_table_hash, 16);
  header.text["build"] = hex(reply.controller.build_id, 16);
  header.text["controller"] = text_in(reply.board) + " (live)";
  header.text["recorded_at_us"] =
      std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(
                         std::chrono::system_clock::now().time_since_epoch())
                         .count());
  for (const link::Description& row : controller.parameters())
    header.text["parameter." + text_in(row.name)] =
        number_text(row.number[3]) + " " + text_in(row.unit);
  return header;
}

// A parameter's Ack in words; empty if the value was accepted.
std::string rejection(const ParameterRequest& request, uint32_t result) {
  switch (result) {
    case link::kAckTaken:
      return "";
    case link::kAckOutOfRange:
      return request.name + ": " + number_text(request.value) + " is out of its range";
    case link::kAckTimerRuns:
      return request.name + ": the board's timer is running and keeps its period";
    default:
      return request.name + ": rejected with code " + std::to_string(result);
  }
}

struct Recording {
  LiveLink& controller;
  QueuedRecords& records;
  std::vector<ParameterRequest> requests;
  uint32_t sent = 0, answered = 0;
  bool is_rejected = false;
  uint64_t received = 0;
  uint32_t first = 0, last = 0;  // numbers

  void take(const link::Frame& frame) {
    link::Ack ack;
    if (frame.type == link::kLog && frame.payload.size() == 4 + records.record_bytes()) {
      if (!records.push(frame.payload.data() + 4)) return;
      last = log::word(frame.payload.data() + 4, 0);
      if (received++ == 0) first = last;
    } else if (frame.type == link::kAck && link::take(frame, ack) && answered < sent) {
      const ParameterRequest& request = requests[answered];
      if (ack.result == link::kAckBusy) {
        controller.set_parameter(request.index,
                                 request.value);  // the mailbox is empty a tick later
        return;
      }
      ++answered;
      const std::string problem = rejection(request, ack.result);
      if (problem.empty()) return;
      std::cerr << "firmtouch-sim: " << problem << "\n";
      is_rejected = true;
    } else if (frame.type == link::kText) {
      std::cerr << "controller: "
                << std::string(reinterpret_cast<const char*>(frame.payload.data()),
                               frame.payload.size())
                << "\n";
    }
  }
  // One at a time: the controller's mailbox holds one command.
  void send_next_request() {
    if (sent != answered || sent == requests.size()) return;
    controller.set_parameter(requests[sent].index, requests[sent].value);
    ++sent;
  }
};

// Prints progress twice a second if stderr is a terminal, and each disk error once.
class Watch {
 public:
  Watch(const Recording& session, log::Recorder& recorder, uint32_t decimation)
      : session_(session), recorder_(recorder), decimation_(decimation) {}
  ~Watch() { clear(); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void update(double now_s) {
    const std::string trouble = recorder_.trouble();
    if (!trouble.empty() && trouble != reported_) {
      clear();
      std::cerr << "firmtouch-sim: " << trouble << "; retrying; memory holds "
                << session_.records.capacity() << " records meanwhile\n";
      reported_ = trouble;
    }
    if (!is_terminal_ || now_s < next_s_) return;
    next_s_ = now_s + 0.5;
    const uint64_t due =
        session_.received > 0 ? (session_.last - session_.first) / decimation_ + uint64_t{1} : 0;
    std::fprintf(
        stderr, "\r\033[K%.1f s, %llu records, %llu missing, %u not yet on disk", now_s,
        static_cast<unsigned long long>(session_.received),
        static_cast<unsigned long long>(due - session_.received + session_.records.dropped()),
        session_.records.waiting());
    std::fflush(stderr);
    is_shown_ = true;
  }

 private:
  void clear() {
    if (is_shown_) std::cerr << "\r\033[K";
    is_shown_ = false;
  }
  const Recording& session_;
  log::Recorder& recorder_;
  const uint32_t decimation_;
  const bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
  double next_s_ = 0.5;
  std::string reported_;
};

int record_live(const cli::Arguments& options) {
  const std::string path = options.text("-o"), asset = options.text("--asset");
  const std::string where = options.positionals()[0];
  if (path.empty()) options.refuse("name -o FILE.ftl");
  if (where.compare(0, 5, "qemu:") == 0)
    cli::fail_usage(where +
                    ": a lock-step controller has no clock of its own; start the emulator with "
                    "-serial null -serial unix:PATH,server=on,wait=off and record unix:PATH");
  const double seconds = options.number("--seconds", 1e9, 0);
  const uint32_t decimation = static_cast<uint32_t>(options.number("--decimate", 1, 1));
  check_outputs({{"--asset", asset}}, {{"-o", path}});

  LiveLink controller(connect_stream(where, wait_s(options)));
  controller.describe();
  std::vector<ParameterRequest> requests = parameter_requests(options, controller);
  controller.begin(decimation);
  const uint32_t crc = controller.reply().controller.asset_crc;
  if (!asset.empty() && Session(asset).controller->asset_crc() != crc)
    throw Refused(asset + ": the controller has another asset, with CRC " + hex(crc, 8));

  constexpr uint32_t kRingBytes = 8u << 20;
  log::Header header = header_of(controller, decimation, asset, path);
  QueuedRecords records(header.record_bytes, kRingBytes / header.record_bytes);
  log::DrainOptions drain;
  drain.file_bytes = static_cast<uint64_t>(options.number("--file-megabytes", 0, 0) * (1 << 20));
  drain.keep_files = static_cast<uint32_t>(options.number("--keep", 0, 0));
  log::Recorder recorder(records, header, drain, path);
  Recording session{controller, records, std::move(requests)};
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  const auto begin = std::chrono::steady_clock::now();
  std::string link_error;
  try {
    Watch watch(session, recorder, decimation);
    for (double now_s = 0; g_stop == 0 && now_s < seconds;
         now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()) {
      session.send_next_request();
      controller.poll(50, [&](const link::Frame& frame) { session.take(frame); });
      watch.update(now_s);
    }
    controller.leave();
  } catch (const Refused& refused) {
    link_error = refused.what();  // the records received before are kept
  }
  const bool is_closed = recorder.stop();
  const log::DrainTotals& totals = recorder.totals();
  if (!link_error.empty()) std::cerr << "firmtouch-sim: " << link_error << "\n";
  if (!is_closed)
    std::cerr << "firmtouch-sim: " << totals.problem << "; " << records.waiting()
              << " received records could not be written\n";
  std::cerr << path << ": " << totals.records << " records, " << totals.missing << " missing, "
            << totals.bytes << " bytes in " << totals.files
            << (totals.files == 1 ? " file" : " files")
            << "; damaged frames: " << controller.rejects() << "\n";
  if (options.has("--json"))
    std::cout << "{\"log\": " << json_text(path) << ", \"records\": " << totals.records
              << ", \"missing\": " << totals.missing << ", \"bytes\": " << totals.bytes
              << ", \"files\": " << totals.files << ", \"damaged_frames\": " << controller.rejects()
              << "}\n";
  if (!link_error.empty() || !is_closed) return 3;
  return totals.missing > 0 || session.is_rejected ? 1 : 0;
}

}  // namespace

cli::Command record_command() {
  return {{"record", "CONTROLLER -o FILE.ftl [options]", 1, 1, record_live},
          "records a running controller over its link until Ctrl-C, or for a given time",
          R"(CONTROLLER: unix:PATH, tcp:HOST:PORT or a serial DEVICE (1 Mbaud).
Exit codes: 0 done; 1 recorded, but records are missing or a parameter was rejected.)",
          {{"-o", "FILE.ftl", "the log"},
           {"--seconds", "S", "duration"},
           {"--decimate", "N", "every N-th tick only (1 Mbaud carries about 690 records a second)"},
           {"--set", "NAME=VALUE", "set a parameter, in its SI unit; may be repeated", true},
           {"--asset", "FILE", "the controller's asset; the log then names it for a replay"},
           {"--file-megabytes", "N", "start a new file after N megabytes"},
           {"--keep", "N", "keep the newest N files"},
           wait_option(),
           {"--json", nullptr, "the summary as JSON on stdout"}}};
}

}  // namespace firmtouch::host_sim
