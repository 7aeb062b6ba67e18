#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "app/app_process.hpp"
#include "app/tick_source.hpp"
#include "firmtouch/asset/container.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/link/handshake.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"

namespace firmtouch::app_test {
namespace {

uint32_t asset_crc() {
  static AssetFile file(FIRMTOUCH_TEST_ASSET);
  static asset::Container container;
  static const bool is_open = asset::open(file.bytes(), container).ok();
  CHECK(is_open);
  return container.crc();
}

link::HelloReply greet(AppProcess& app, uint32_t mode, uint32_t crc) {
  link::Hello hello;
  hello.host = identity(crc);
  hello.mode = mode;
  link::HelloReply reply;
  for (;;) {
    app.send(link::kHello, hello);
    const Message message = app.receive(link::kHelloReply);
    CHECK(message.take(reply));
    if (message.type == 0 || (reply.refused & link::kRefusedNotReady) == 0) return reply;
  }
}

// A folder of this test's own, gone with it.
struct Folder {
  Folder() {
    const char* base = std::getenv("TMPDIR");
    name = std::string(base != nullptr ? base : "/tmp") + "/firmtouch-app-XXXXXX";
    CHECK(::mkdtemp(name.data()) != nullptr);
  }
  ~Folder() { ::rmdir(name.c_str()); }
  std::string name;
};

TEST(LiveTicks_AreNumbered_LostOnesCounted) {
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, link::kModeLive, asset_crc()).refused, 0u);
  link::Log before;
  CHECK(app.receive(link::kLog).take(before));
  for (uint32_t i = 0; i < 200; ++i) {
    link::Log log;
    CHECK(app.receive(link::kLog).take(log));
    CHECK_EQ(log.record.number - before.record.number, 1 + log.dropped - before.dropped);
    const record::TickRecord& tick = log.record.value;
    CHECK_EQ(tick.input.tick, log.record.number);
    CHECK_EQ(tick.input.flags, record::kFlagEncoderFault);  // a process has no joints
    for (const float force_N : tick.output.motor_N) CHECK_EQ(force_N, 0.0f);
    before = log;
  }
}

// Of the same index as the request.
template <class Reply, class Request>
Reply reply_to(AppProcess& app, uint8_t type, const Request& request, uint8_t reply_type) {
  app.send(type, request);
  Reply reply;
  CHECK(app.receive(reply_type).take(reply));
  CHECK_EQ(reply.index, request.index);
  return reply;
}

// Of 300 messages one acknowledges a command, and one records it.
link::Ack acknowledged(AppProcess& app, record::TickRecord& commanded) {
  link::Ack ack;
  uint32_t acknowledgements = 0, commands = 0;
  for (uint32_t i = 0; i < 300; ++i) {
    const Message message = app.receive();
    link::Log log;
    if (message.type == link::kAck && message.take(ack)) ++acknowledgements;
    if (message.type != link::kLog || !message.take(log) || log.record.value.input.command == 0)
      continue;
    commanded = log.record.value;
    ++commands;
  }
  CHECK_EQ(acknowledgements, 1u);
  CHECK_EQ(commands, 1u);
  return ack;
}

TEST(Parameter_IsChecked_Acknowledged_AndRecordedInOneTick) {
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, link::kModeLive, asset_crc()).refused, 0u);
  const auto result_of = [&](uint32_t index, float value) {
    link::SetParam set;
    set.index = index;
    set.value = value;
    return reply_to<link::Ack>(app, link::kSetParam, set, link::kAck).result;
  };
  CHECK_EQ(result_of(params::kCount, 1.0f), link::kAckNoSuchParameter);
  CHECK_EQ(result_of(UINT32_MAX, 1.0f), link::kAckNoSuchParameter);
  CHECK_EQ(result_of(params::kTickPeriod, 0.2f), link::kAckOutOfRange);
  CHECK_EQ(result_of(params::kForceLimit, NAN), link::kAckOutOfRange);
  CHECK_EQ(result_of(params::kForceLimit, INFINITY), link::kAckOutOfRange);
  CHECK_EQ(result_of(params::kForceLimit, -1.0f), link::kAckOutOfRange);

  link::SetParam set;
  set.index = params::kForceLimit;
  set.value = 3.5f;
  app.send(link::kSetParam, set);
  record::TickRecord commanded;
  CHECK_EQ(acknowledged(app, commanded).result, link::kAckTaken);
  CHECK_EQ(commanded.input.command, 1 + params::kForceLimit);
  CHECK_EQ(commanded.input.command_value, 3.5f);
}

TEST(Describe_ReturnsEveryParameterAndFault) {
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  const auto row_of = [&](uint16_t what, uint16_t index) {
    link::Describe wanted;
    wanted.what = what;
    wanted.index = index;
    return reply_to<link::Description>(app, link::kDescribe, wanted, link::kDescription);
  };
  for (uint16_t i = 0; i < params::kCount; ++i) {
    const link::Description row = row_of(link::kDescribeParameter, i);
    CHECK_EQ(row.rows, uint16_t{params::kCount});
    CHECK(std::string(row.name, ::strnlen(row.name, sizeof row.name)) == params::kTable[i].name);
    CHECK(std::string(row.text, ::strnlen(row.text, sizeof row.text)) == params::kTable[i].what);
    CHECK_EQ(row.number[0], params::kTable[i].low);
    CHECK_EQ(row.number[1], params::kTable[i].high);
  }
  uint32_t faults = 0;
  const uint16_t rows = row_of(link::kDescribeBit, 0).rows;
  for (uint16_t i = 0; i < rows; ++i) {
    const link::Description row = row_of(link::kDescribeBit, i);
    if (std::string(row.unit) != "output.faults") continue;
    CHECK_NE(row.text[0], 0);
    CHECK_EQ(row.text[sizeof row.text - 1], 0);  // none is cut off
    CHECK_EQ(uint32_t{row.kind}, faults++);
  }
  CHECK_EQ(faults, servo::kFaultCount);
}

TEST(ClearFaults_ReachesTheTick) {
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  app.send(link::kClearFaults, link::ClearFaults{});
  CHECK_EQ(app.receive().type, link::kText);  // nobody has said Hello yet
  CHECK_EQ(greet(app, link::kModeLive, asset_crc()).refused, 0u);
  app.send(link::kClearFaults, link::ClearFaults{});
  record::TickRecord commanded;
  const link::Ack ack = acknowledged(app, commanded);
  CHECK_EQ(ack.index, link::kAckOfClearFaults);
  CHECK_EQ(ack.result, link::kAckTaken);
  CHECK_EQ(commanded.input.command, record::kCommandClearFaults);
  CHECK_NE(commanded.output.state & record::kStateCommandTaken, 0u);  // its enable line is low
}

TEST(LockStep_WhileTheTimerRuns_IsRejected) {
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, link::kModeLive, asset_crc()).refused, 0u);
  CHECK_EQ(greet(app, link::kModeLockStep, asset_crc()).refused, link::kRefusedBusy);
}

TEST(DamagedAsset_IsRejectedByItsRule_LinkStaysAlive) {
  AssetFile file(FIRMTOUCH_TEST_ASSET);
  file.data()[file.bytes().size() / 2] ^= 1;
  Folder folder;
  const std::string path = folder.name + "/damaged.fta";
  std::FILE* out = std::fopen(path.c_str(), "wb");
  CHECK(out != nullptr);
  if (out == nullptr) return;
  CHECK_EQ(std::fwrite(file.data(), 1, file.bytes().size(), out), size_t{file.bytes().size()});
  std::fclose(out);
  asset::Container container;
  const core::Verdict expected = asset::open(file.bytes(), container);
  CHECK(!expected.ok());
  {
    AppProcess app(path);
    for (uint32_t i = 0; i < 3; ++i) {
      const link::HelloReply reply = greet(app, link::kModeLockStep, asset_crc());
      CHECK_EQ(reply.refused, link::kRefusedAssetRejected);
      CHECK_EQ(reply.asset_rule, expected.rule);
      CHECK_EQ(reply.asset_element, expected.element);
    }
    CHECK(app.first_line().find("rule R" + std::to_string(expected.rule)) != std::string::npos);
  }
  ::unlink(path.c_str());
}

TEST(ByeExitEndsTheProgramAndByeLeaveDoesNot) {
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, link::kModeLockStep, asset_crc()).refused, 0u);
  link::Bye bye;
  bye.what = link::kByeLeave;
  app.send(link::kBye, bye);
  app.send(link::kStep, link::Step{input_of(0)});
  CHECK_EQ(app.receive().type, link::kText);
  bye.what = link::kByeExit;
  app.send(link::kBye, bye);
  CHECK_EQ(app.wait(), 0);
}

TEST(AHostThatGoesAwayEndsTheProcess) {
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, link::kModeLive, asset_crc()).refused, 0u);
  app.close_link();
  CHECK_EQ(app.wait(), 0);
}

TEST(ItAnswersOnAUnixSocketOfItsOwn) {
  Folder folder;
  const std::string path = folder.name + "/link";
  AppProcess app(
      std::vector<std::string>{"--link", "listen:" + path, "--asset", FIRMTOUCH_TEST_ASSET});
  CHECK(app.connect(path));
  CHECK_EQ(greet(app, link::kModeLockStep, asset_crc()).refused, 0u);
}

TEST(ItAnswersOnAPseudoTerminal) {
  AppProcess app(std::vector<std::string>{"--asset", FIRMTOUCH_TEST_ASSET, "--link", "pty"});
  CHECK(app.open_terminal(app.first_line()));
  CHECK_EQ(greet(app, link::kModeLockStep, asset_crc()).refused, 0u);
}

int status_of(const std::vector<std::string>& options) { return AppProcess(options).wait(); }

TEST(WrongOption_ExitsWith2_MissingFile_ExitsWith3) {
  const std::string asset = FIRMTOUCH_TEST_ASSET;
  using Options = std::vector<std::string>;
  CHECK_EQ(status_of(Options{}), 2);
  CHECK_EQ(status_of(Options{"--asset"}), 2);
  CHECK_EQ(status_of(Options{"--what", "x"}), 2);
  CHECK_EQ(status_of(Options{"--help"}), 0);
  CHECK_EQ(status_of(Options{"--asset", "missing.fta", "--link", "pty"}), 3);
  CHECK_EQ(status_of(Options{"--asset", asset, "--link", "unix:missing"}), 3);
  CHECK_EQ(status_of(Options{"--asset", asset, "--link", "missing"}), 3);
}

}  // namespace
}  // namespace firmtouch::app_test
