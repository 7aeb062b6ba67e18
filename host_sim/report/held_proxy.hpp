#pragma once
#include <algorithm>
#include <vector>

#include "firmtouch/scene/proxy.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// What holds the proxy in a tick, device frame. Of a tool of spheres: the one with the least room.
struct HeldProxy {
  /// '1' to '3': so many planes; '0': none is known; 'i': the tool began inside and is led out;
  /// 'p': penalty contact, which has no proxy; '-': no contact.
  char kind = '-';
  Vec proxy_m, hand_m;       // the hand from the proxy
  std::vector<Vec> normals;  // of the planes; unit, outward
  double friction_static = 0, friction_dynamic = 0;
};

/// Reads it from the controller of a run, which the record's inputs drive: the record has no
/// planes.
class HeldProxies {
 public:
  /// `session` outlives this.
  explicit HeldProxies(const Session& session) : session_(session) {}
  /// Pre: called for each tick in order, right after the session's controller ran it. At two rates
  /// the planes are those of the model that the tick used.
  HeldProxy after(const record::TickRecord& record);

 private:
  HeldProxy read(Vec tool_m) const;

  const Session& session_;
  HeldProxy used_, made_;
};

}  // namespace firmtouch::host_sim
