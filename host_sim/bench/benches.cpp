#include "host_sim/bench/benches.hpp"

namespace firmtouch::host_sim {

std::vector<bench::Bench> rig_benches() {
  return {
      {"feel", "contact with walls, corners, grooves, slots, plates; penalty contact beside it",
       run_contact_bench},
      {"friction", "friction: force ratio, creep, stick-slip", run_friction_bench},
      {"passivity", "energy that contact and guides give to the hand", run_passivity_bench},
  };
}

}  // namespace firmtouch::host_sim
