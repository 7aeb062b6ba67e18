// Scenario files: every statement, and every kind of mistake with its line.
#include <string>
#include <vector>

#include "device/line_reader.hpp"
#include "device/units.hpp"
#include "harness/test.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/run.hpp"

namespace host_sim = firmtouch::host_sim;
using host_sim::Event;
using host_sim::Move;
using host_sim::Scenario;

namespace {

bool near(double a, double b) { return std::abs(a - b) <= 1e-12 * (1 + std::abs(b)); }

Scenario read(const std::string& text, const std::vector<std::string>& sets = {}) {
  return host_sim::read_scenario("test.scenario", text, sets, host_sim::parameter_rows());
}

std::string refusal(const std::string& text, const std::vector<std::string>& sets = {}) {
  try {
    read(text, sets);
  } catch (const host_sim::Refused& refused) {
    return refused.what();
  }
  return "not refused";
}

bool says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return true;
  firmtouch::test::print(("  message: " + message + "\n  lacks:   " + part + "\n").c_str());
  return false;
}

const std::string kHead = "asset a.fta\nduration 1 s\n";

}  // namespace

TEST(Scenario_EveryStatement_ConvertsToSi) {
  const Scenario s = read(
      "# a comment\nasset my part.fta  # with a blank\nrate 4 kHz\nduration 2500 ms\nmass 75 "
      "g\nviscous_friction 0.5 N.s/m\n"
      "coulomb_friction 20 mN\nencoder_quantum 30 um\nmotor_limit 10 N\noutput_delay 1 "
      "samples\nhand_stiffness 0.4 N/mm\n"
      "hand_damping 4 Ns/m\nstart 1 2 -3 cm\ncontact_stiffness 800 N/m\ntool_radius_m 5 "
      "mm\nmesh_work 64\n"
      "\tmove to 0 0 0.1 m at 50 mm/s\nhold for 1 s\npress 0 0 0.01 m for 0.5 s\n"
      "follow guide at 0.05 m/s for 4 s pressing 2 mm\nat 2 s set guide_stiffness 100 N/m\nat 1.5 "
      "s emergency_stop\n");
  CHECK(s.asset == "my part.fta");
  CHECK(near(s.rate_Hz, 4000) && near(s.duration_s, 2.5) && near(s.device.mass_kg, 0.075));
  CHECK(near(s.device.viscous_N_s_per_m, 0.5) && near(s.device.coulomb_N, 0.02));
  CHECK(near(s.device.encoder_quantum_m, 30e-6) && near(s.device.force_limit_N, 10));
  CHECK_EQ(s.device.output_delay_samples, 1u);
  CHECK(near(s.hand.stiffness_N_per_m, 400) && near(s.hand.damping_N_s_per_m, 4));
  CHECK(near(s.start_m.x, 0.01) && near(s.start_m.z, -0.03));
  CHECK_EQ(s.settings.size(), 3u);
  CHECK(near(s.settings[0].value, 800) && near(s.settings[1].value, 0.005) &&
        near(s.settings[2].value, 64));
  CHECK_EQ(s.moves.size(), 4u);
  CHECK(s.moves[3].kind == Move::Kind::kFollow && near(s.moves[3].press_m, 0.002));
  CHECK_EQ(s.events.size(), 2u);  // in order of time
  CHECK(s.events[0].kind == Event::Kind::kEmergencyStop && s.events[1].kind == Event::Kind::kSet);
}

// Budgets that counted visits, of two and a half units, wherever a parameter is set.
TEST(Scenario_FormerNames_AreConvertedInLinesSetsAndEvents) {
  const Scenario s =
      read(kHead + "mesh_steps 16\nat 3 s set curve_steps 20\nat 4 s set mesh_steps 40000\n",
           {"curve_steps 40000"});
  CHECK_EQ(s.settings.size(), 2u);
  CHECK(near(s.settings[0].value, 40) && near(s.settings[1].value, 65536));
  CHECK_EQ(s.events.size(), 2u);
  CHECK(near(s.events[0].value, 50) && near(s.events[1].value, 65536));
  const auto rows = host_sim::parameter_rows();
  CHECK(rows[s.settings[0].parameter].short_name == "mesh_work");
  CHECK(rows[s.events[0].parameter].short_name == "guide_work");
  CHECK(says(refusal(kHead + "at 3 s set mesh_steps 65537\n"), "65536"));
}

TEST(Scenario_EveryMistake_ReportsItsLine) {
  struct Case {
    const char* line;
    const char* says;
  };
  constexpr Case kCases[] = {
      {"masss 1 kg", "did you mean `mass`"},
      {"stiffness 800 N/m",
       "did you mean `hand_stiffness`, `hand_arm_stiffness`, `contact_stiffness`, "
       "`guide_stiffness`?"},
      {"mass 1 m", "`m` is not a unit for `mass`; write one of: kg, g"},
      {"mass 1 pound", "`pound` is not a unit"},
      {"mass 1", "the unit of `mass`"},
      {"mass", "the value of `mass`"},
      {"mass one kg", "needs a number instead of `one`"},
      {"mass nan kg", "needs a number instead of `nan`"},
      {"mass inf kg", "needs a number instead of `inf`"},
      {"mass -1 kg", "outside"},
      {"mass 1 kg 2", "unexpected `2`"},
      {"contact_stiffness 1e9 N/m", "outside"},
      {"mesh_work 3 m", "unexpected `m`"},
      {"start 1 2 m", "needs a number"},
      {"start 1 2 3", "the unit of `start`"},
      {"start 1 2 1e9 m", "outside"},
      {"move 1 2 3 m at 1 m/s", "`to` is expected"},
      {"move to 1 2 3 m", "`at`"},
      {"move to 1 2 3 m at 0 m/s", "outside"},
      {"follow guide at 1 m/s", "`for`"},
      {"follow path at 1 m/s for 1 s", "`guide` is expected"},
      {"startle 1 2 m", "needs a number"},
      {"startle 0 0 1 m for 1 s", "unexpected `for`"},
      {"let_go", "`for`"},
      {"let_go for 0 s", "outside"},
      {"hand_tremor -1 mm", "outside"},
      {"hand_tremor_frequency 0 Hz", "outside"},
      {"hand_stiffening 1 m", "`m` is not a unit"},
      {"at 1 s explode", "unknown event `explode`"},
      {"at 1 m emergency_stop", "`m` is not a unit"},
      {"at 1 s set nothing 1", "unknown parameter `nothing`"},
      {"at 1 s fail encoder 0", "unknown failure `encoder`; known: encoder_stuck, "},
      {"at 1 s fail motor_dead 0.5", "a joint is 0, 1 or 2"},
      {"at 1 s fail motor_dead 3", "0 to 2"},
      {"duration 2 s", "`duration` is given twice"},
  };
  for (const Case& c : kCases) {
    const std::string message = refusal(kHead + c.line + "\n");
    CHECK(says(message, "test.scenario:3: "));
    CHECK(says(message, c.says));
  }
}

TEST(Scenario_WithoutAssetOrEnd_IsRejected) {
  CHECK(says(refusal("duration 1 s\n"), "it has no asset"));
  CHECK(says(refusal("asset a.fta\n"), "no end"));
}

TEST(Set_ReplacesValue_NeedsUnit) {
  const Scenario s =
      read(kHead + "mass 1 kg\ntool_radius 1 mm\n", {"mass 80 g", "tool_radius 4 mm"});
  CHECK(near(s.device.mass_kg, 0.08));
  CHECK_EQ(s.settings.size(), 1u);
  CHECK(near(s.settings[0].value, 0.004));
  CHECK(says(refusal(kHead, {"mas 1"}), "--set mas 1: unknown key"));
  CHECK(says(refusal(kHead, {"mass 60"}), "the unit of `mass` (kg, g)"));
  CHECK(says(refusal(kHead, {"tool_radius 0.004"}), "the unit of `tool_radius`"));
}

TEST(QuotedPath_RoundTrips_ForAnyPath) {
  for (const std::string path :
       {"a.fta", "gear #2.fta", "#1", " leading", "trailing ", "a#b", "a\"b\"", "back\\slash",
        "back\\", "two\nlines", "\ttab", "\"", "\\n"}) {
    const std::string line = "asset " + firmtouch::tools::path_word(path);
    CHECK(read(line + "\nduration 1 s\n").asset == path);
    CHECK(read(line + "  # \"a\" comment\nduration 1 s\n").asset == path);
  }
  CHECK(read("asset gear#2.fta # comment\nduration 1 s\n").asset == "gear#2.fta");
  CHECK(says(refusal("asset \"a.fta\n"), "a quoted path must end with a quote"));
  CHECK(says(refusal("asset \"a.fta\" b\n"), "a quoted path must end with a quote"));
}

TEST(Units_OtherDimension_DoNotConvert) {
  CHECK(near(*firmtouch::tools::to_si(2, "N/mm", "N/m"), 2000));
  CHECK(near(*firmtouch::tools::to_si(2, "N*s/m", "N s/m"), 2));
  CHECK(!firmtouch::tools::to_si(2, "N", "N/m"));
  CHECK(!firmtouch::tools::to_si(2, "", "m"));
}

// A new parameter of the controller must be writable in a scenario.
TEST(Scenario_EveryParameter_CanBeSetByName) {
  for (const host_sim::ParameterRow& row : host_sim::parameter_rows()) {
    const Scenario s =
        read(kHead,
             {row.short_name + " " + std::to_string(row.initial) +
              (row.unit.empty() ? ""
                                : " " + firmtouch::tools::units_like(row.unit).substr(
                                            0, firmtouch::tools::units_like(row.unit).find(',')))});
    CHECK_EQ(s.settings.size(), 1u);
    if (!row.unit.empty() && !firmtouch::tools::to_si(1, row.unit, row.unit))
      CHECK(says("", row.unit));
    CHECK(row.unit.empty() || firmtouch::tools::units_like(row.unit) != "");
  }
}

TEST(Help_ListsEveryParameter) {
  const std::string help = host_sim::parameter_help();
  for (const host_sim::ParameterRow& row : host_sim::parameter_rows())
    CHECK(help.find("\n  " + row.short_name + " VALUE") != std::string::npos);
}
