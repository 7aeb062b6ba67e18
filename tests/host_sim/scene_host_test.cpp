// Which surface and guide of an asset with several the simulator uses.
#include <cmath>
#include <string>

#include "harness/test.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/part_asset.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace host_sim = firmtouch::host_sim;
using firmtouch::test::part_asset;
using firmtouch::test::two_part_asset;
using host_sim::Session;

namespace {

template <class Act>
std::string refusal(const Act& act) {
  try {
    act();
  } catch (const host_sim::Refused& refused) {
    return refused.what();
  }
  return "not refused";
}

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

host_sim::Scenario scenario_with(const std::string& lines) {
  return host_sim::read_scenario("test.scenario", "asset a.fta\nduration 1 s\n" + lines, {},
                                 host_sim::parameter_rows());
}

}  // namespace

TEST(Session_WithoutNames_UsesTheFirstAndListsTheOthers) {
  const Session session(two_part_asset());
  CHECK(session.used.surface == "lid" && session.used.guide == "path");
  CHECK(session.is_default());
  CHECK(session.scene_text() ==
        "surface `lid`, guide `path`; not used: surface `part`, guide `rim`");
}

TEST(Session_WithNames_UsesThem) {
  const Session named(two_part_asset(), {"part", "rim"}), first(two_part_asset()),
      alone(part_asset());
  CHECK(named.scene_text() == "surface `part`, guide `rim`; not used: surface `lid`, guide `path`");
  CHECK(!named.is_default());
  const auto triangles = [](const Session& s) {
    return s.controller->mesh().head().triangle_count;
  };
  CHECK_EQ(triangles(named), triangles(alone));
  CHECK(triangles(named) != triangles(first));
  // The guides differ too.
  const auto begin = [](const Session& s) { return s.controller->curve().samples()[0]; };
  CHECK(std::fabs(begin(named).x_m - begin(first).x_m) +
            std::fabs(begin(named).y_m - begin(first).y_m) >
        0);
}

TEST(Session_UnknownName_ListsTheNamesOfTheAsset) {
  CHECK(contains(refusal([] {
                   Session(two_part_asset(), {"bolt", ""});
                 }),
                 "it has no surface `bolt`; it has: `lid`, `part`"));
  CHECK(contains(refusal([] {
                   Session(two_part_asset(), {"", "part"});
                 }),
                 "it has no guide `part`; it has: `path`, `rim`"));
}

TEST(RemoteController_OtherSceneThanTheFirst_IsRejected) {
  const Session first(two_part_asset()), named(two_part_asset(), {"part", ""});
  host_sim::check_scene(first, "unix:port");
  host_sim::check_scene(named, "inproc");
  CHECK(contains(refusal([&] { host_sim::check_scene(named, "unix:port"); }), "run in-process"));
}

TEST(Scenario_MeshAndGuide_NameTheScene) {
  const host_sim::Scenario scenario = scenario_with("mesh upper lid\nguide \"rim 2\"\n");
  CHECK(scenario.scene.surface == "upper lid" && scenario.scene.guide == "rim 2");
  CHECK(scenario_with("").scene.surface.empty());
  CHECK(contains(refusal([] { scenario_with("mesh a\nmesh b\n"); }), "`mesh` is given twice"));
}
