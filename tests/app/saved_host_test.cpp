// Parameters that a host saves come back after a restart: as commands of the first ticks, so that a
// replay of the record sets them too.
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "app/app_process.hpp"
#include "firmtouch/params/table.hpp"
#include "harness/test.hpp"

namespace firmtouch::app_test {
namespace {

using Options = std::vector<std::string>;

struct Place {
  Place() {
    const char* base = std::getenv("TMPDIR");
    folder = std::string(base != nullptr ? base : "/tmp") + "/firmtouch-saved-XXXXXX";
    CHECK(::mkdtemp(folder.data()) != nullptr);
  }
  ~Place() {
    ::unlink((folder + "/flash").c_str());
    ::rmdir(folder.c_str());
  }
  Options options() const {
    return {"--link",       "listen:" + folder + "/link",
            "--asset",      FIRMTOUCH_TEST_ASSET,
            "--parameters", folder + "/flash"};
  }
  std::string folder;
};

// The asset's CRC and the rest of the identity are the program's own.
void go_live(AppProcess& app, const Place& place) {
  CHECK(app.connect(place.folder + "/link"));
  link::Hello hello;
  link::HelloReply reply;
  do {
    app.send(link::kHello, hello);
    CHECK(app.receive(link::kHelloReply).take(reply));
    hello.host = reply.controller;
  } while (reply.refused != 0);
}

uint32_t answer_of(AppProcess& app, uint8_t type, core::Bytes payload) {
  link::Ack ack;
  do {
    app.send_frame(type, payload);
    CHECK(app.receive(link::kAck).take(ack));
  } while (ack.result == link::kAckBusy);
  return ack.result;
}

void set_parameter(AppProcess& app, uint32_t row, float value) {
  link::SetParam wanted;
  wanted.index = row;
  wanted.value = value;
  CHECK_EQ(answer_of(app, link::kSetParam, link::bytes_of(wanted)), link::kAckTaken);
}

float present_value(AppProcess& app, uint16_t row) {
  app.send(link::kDescribe, link::Describe{link::kDescribeParameter, row});
  link::Description description;
  CHECK(app.receive(link::kDescription).take(description));
  return description.number[3];
}

TEST(SavedParameters_AfterAKill_AreCommandsOfTheFirstTicks) {
  const Place place;
  const link::SaveParameters save;
  {
    AppProcess app(place.options());
    go_live(app, place);
    set_parameter(app, params::kOriginX, 0.25f);
    set_parameter(app, params::kTickPeriod, 0.002f);
    CHECK_EQ(answer_of(app, link::kSaveParameters, link::bytes_of(save)), link::kAckTaken);
    set_parameter(app, params::kOriginX, 0.5f);  // not saved
  }
  AppProcess app(place.options());
  go_live(app, place);
  link::Log first, second;
  CHECK(app.receive(link::kLog).take(first));
  CHECK(app.receive(link::kLog).take(second));
  CHECK_EQ(first.record.value.input.tick, 0u);
  CHECK_EQ(first.record.value.input.command, 1 + params::kTickPeriod);
  CHECK_EQ(first.record.value.input.command_value, 0.002f);
  CHECK_EQ(second.record.value.input.command, 1 + params::kOriginX);
  CHECK_EQ(second.record.value.input.command_value, 0.25f);
  CHECK_EQ(present_value(app, params::kOriginX), 0.25f);
  CHECK_EQ(present_value(app, params::kTickPeriod), 0.002f);
  // The timer follows the period.
  link::Log log;
  for (uint32_t i = 0; i < 100; ++i) CHECK(app.receive(link::kLog).take(log));
  const uint32_t took_us = log.record.value.input.clock_us - second.record.value.input.clock_us;
  const uint32_t ticks = log.record.value.input.tick - second.record.value.input.tick;
  CHECK_GE(took_us, ticks * 2000 - 5000);
}

TEST(SavedParameters_WithoutFlash_AreRefusedByName) {
  Place place;
  Options options = place.options();
  options.resize(4);
  AppProcess app(options);
  go_live(app, place);
  const link::SaveParameters save;
  CHECK_EQ(answer_of(app, link::kSaveParameters, link::bytes_of(save)), link::kAckNoFlash);
}

}  // namespace
}  // namespace firmtouch::app_test
