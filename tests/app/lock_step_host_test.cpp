#include <cstring>

#include "app/app_process.hpp"
#include "app/tick_source.hpp"
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/link/handshake.hpp"
#include "harness/test.hpp"

namespace firmtouch::app_test {
namespace {

constexpr uint32_t kTicks = 1000;
constexpr uint32_t kContact = 1u << 8;
constexpr uint32_t kOnGuide = 1u << 9;

// The same asset in this process.
struct Inproc {
  Inproc() : asset(FIRMTOUCH_TEST_ASSET) { CHECK(controller.open(asset.bytes()).ok()); }
  AssetFile asset;
  FullController controller;
};

link::HelloReply greet(AppProcess& app, const link::Identity& host, uint32_t mode) {
  link::Hello hello;
  hello.host = host;
  hello.mode = mode;
  link::HelloReply reply;
  for (;;) {  // repeated while the asset is being proven
    const uint16_t sequence = app.send(link::kHello, hello);
    const Message message = app.receive(link::kHelloReply);
    CHECK_EQ(message.sequence, sequence);
    CHECK(message.take(reply));
    if (message.type == 0 || (reply.refused & link::kRefusedNotReady) == 0) return reply;
  }
}

link::StepReply step(AppProcess& app, const record::TickInput& input) {
  const uint16_t sequence = app.send(link::kStep, link::Step{input});
  const Message message = app.receive(link::kStepReply);
  CHECK_EQ(message.sequence, sequence);
  link::StepReply reply;
  CHECK(message.take(reply));
  CHECK_EQ(reply.tick, input.tick);
  return reply;
}

bool same_bits(const record::TickOutput& a, const record::TickOutput& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(LockStep_ThousandSteps_EqualAControllerInThisProcess) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  const link::HelloReply reply =
      greet(app, identity(here.controller.asset_crc()), link::kModeLockStep);
  CHECK_EQ(reply.refused, 0u);
  CHECK(std::strcmp(reply.board, "posix") == 0);
  CHECK_EQ(reply.servo_period_us, 1000u);
  uint32_t in_contact = 0, on_guide = 0, different = 0;
  for (uint32_t i = 0; i < kTicks; ++i) {
    record::TickOutput expected{};
    here.controller.tick(input_of(i), expected);
    if (!same_bits(step(app, input_of(i)).output, expected)) ++different;
    if ((expected.state & kContact) != 0) ++in_contact;
    if ((expected.state & kOnGuide) != 0) ++on_guide;
  }
  CHECK_EQ(different, 0u);
  CHECK_GE(in_contact, 400u);  // the path does touch: the bits are not those of standing still
  CHECK_GE(on_guide, 400u);
  CHECK_EQ(here.controller.values()[params::kContactStiffness], 650.0f);
}

TEST(RepeatedStep_IsAnsweredAgain_WithoutASecondTick) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, identity(here.controller.asset_crc()), link::kModeLockStep).refused, 0u);
  for (uint32_t i = 0; i < 500; ++i) {
    record::TickOutput expected{};
    here.controller.tick(input_of(i), expected);
    CHECK(same_bits(step(app, input_of(i)).output, expected));
    if (i % 3 == 0) CHECK(same_bits(step(app, input_of(i)).output, expected));
  }
}

TEST(EachHelloBeginsAFreshController) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  for (uint32_t round = 0; round < 2; ++round) {
    CHECK_EQ(greet(app, identity(here.controller.asset_crc()), link::kModeLockStep).refused, 0u);
    here.controller.reset();
    for (uint32_t i = 0; i < 700; ++i) {
      record::TickOutput expected{};
      here.controller.tick(input_of(i), expected);
      CHECK(same_bits(step(app, input_of(i)).output, expected));
    }
  }
}

TEST(GarbageBetweenFrames_LosesNoFrame) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  app.send_bytes({0xF7, 0x5A, 1, 2, 3, 0xF7, 0xF7, 0x5A, 0, 0});
  CHECK_EQ(greet(app, identity(here.controller.asset_crc()), link::kModeLockStep).refused, 0u);
  for (uint32_t i = 0; i < 50; ++i) {
    record::TickOutput expected{};
    here.controller.tick(input_of(i), expected);
    app.send_bytes(std::vector<uint8_t>(i, 0xF7));
    CHECK(same_bits(step(app, input_of(i)).output, expected));
  }
}

// The refusal as the host's user reads it.
std::string refusal(const link::Identity& host, const link::HelloReply& reply) {
  char text[1200];
  link::explain(host, reply, text);
  return text;
}
bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
std::string hex(uint64_t value) {
  char text[19];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(value));
  return text;
}

TEST(AnotherProtocolIsRefusedNamingBoth) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  link::Identity host = identity(here.controller.asset_crc());
  host.protocol = 77;
  const link::HelloReply reply = greet(app, host, link::kModeLockStep);
  CHECK_EQ(reply.refused, link::kRefusedProtocol);
  CHECK(contains(refusal(host, reply), "protocol version: host 77, controller 7"));
  // Nor may another version's Hello be as long as ours.
  const uint32_t longer[20] = {78};
  app.send(link::kHello, longer);
  link::HelloReply second;
  CHECK(app.receive(link::kHelloReply).take(second));
  CHECK_EQ(second.refused, link::kRefusedProtocol);
}

TEST(Hello_OtherParameterTable_IsRejected_NamingBoth) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  link::Identity host = identity(here.controller.asset_crc());
  const uint64_t right = host.parameter_table_hash;
  host.parameter_table_hash = ~right;
  const link::HelloReply reply = greet(app, host, link::kModeLockStep);
  CHECK_EQ(reply.refused, link::kRefusedParameterTable);
  const std::string text = refusal(host, reply);
  CHECK(contains(text, "parameter table hash: host " + hex(~right) + ", controller " + hex(right)));
  CHECK(contains(app.first_line(), hex(right)));  // the controller's own console says the same
}

TEST(AnotherAssetOrBuildIsRefusedAndTheNextRightHelloAccepted) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  link::Identity host = identity(here.controller.asset_crc() ^ 1u);
  host.build_id ^= 1;
  CHECK_EQ(greet(app, host, link::kModeLockStep).refused,
           link::kRefusedAsset | link::kRefusedBuild);
  app.send(link::kStep, link::Step{input_of(0)});
  const Message answer = app.receive();
  CHECK_EQ(answer.type, link::kText);
  CHECK(contains(answer.text(), "before an accepted Hello"));
  CHECK_EQ(greet(app, identity(here.controller.asset_crc()), 9).refused, link::kRefusedMode);
  CHECK_EQ(greet(app, identity(here.controller.asset_crc()), link::kModeLockStep).refused, 0u);
}

TEST(ARefusedHelloEndsTheLockStepBeforeIt) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, identity(here.controller.asset_crc()), link::kModeLockStep).refused, 0u);
  step(app, input_of(0));
  CHECK_NE(greet(app, identity(here.controller.asset_crc() ^ 1u), link::kModeLockStep).refused, 0u);
  app.send(link::kStep, link::Step{input_of(1)});
  CHECK_EQ(app.receive().type, link::kText);
}

TEST(FrameOfWrongLengthOrType_IsAnsweredByText) {
  Inproc here;
  AppProcess app(FIRMTOUCH_TEST_ASSET);
  CHECK_EQ(greet(app, identity(here.controller.asset_crc()), link::kModeLockStep).refused, 0u);
  for (const uint8_t type : std::vector<uint8_t>{link::kHello, link::kStep, link::kSetParam,
                                                 link::kBye, link::kClearFaults, 0x77}) {
    app.send_frame(type, {});
    CHECK_EQ(app.receive().type, link::kText);
  }
  link::SetParam set;
  app.send(link::kSetParam, set);
  link::Ack ack;
  CHECK(app.receive(link::kAck).take(ack));
  CHECK_EQ(ack.result, link::kAckInLockStep);
  app.send(link::kClearFaults, link::ClearFaults{});
  CHECK(app.receive(link::kAck).take(ack));
  CHECK_EQ(ack.index, link::kAckOfClearFaults);
  CHECK_EQ(ack.result, link::kAckInLockStep);
  step(app, input_of(0));  // and it goes on
}

}  // namespace
}  // namespace firmtouch::app_test
