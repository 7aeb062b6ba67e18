#include <string>

#include "firmtouch/link/handshake.hpp"
#include "harness/test.hpp"
#include "host_sim/controllers/asset_remedy.hpp"

// What the simulator says of a controller that rejects its session.

using namespace firmtouch;

namespace {

std::string refusal(const link::Identity& host, const link::Identity& controller) {
  link::HelloReply reply;
  reply.controller = controller;
  reply.refused = link::compare(host, controller);
  return host_sim::refusal_text(host, reply);
}
bool names_the_parts(const std::string& text) {
  return text.find("FIRMTOUCH_APP=all") != std::string::npos;
}

}  // namespace

TEST(Refusal_OtherParametersOfTheSameSources_AreThePartsOfTheProgram) {
  link::Identity host, controller;
  controller.parameter_table_hash = 1;
  const std::string text = refusal(host, controller);
  CHECK(text.find("parameter table hash: host 0x") == 0);
  CHECK(text.find("from the same sources") == std::string::npos);
  CHECK(names_the_parts(text));
  controller.build_id = 1;  // of other sources
  CHECK(!names_the_parts(refusal(host, controller)));
  controller.parameter_table_hash = 0;
  CHECK(!names_the_parts(refusal(host, controller)));
}
