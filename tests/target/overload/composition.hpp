#pragma once
#include "busy_surface.hpp"
#include "firmtouch/controller/controller.hpp"

namespace firmtouch::app {

/// A controller that keeps what its last tick gave, for the program that overloads it.
class AppController : public Controller<Surfaces<target::BusySurface>> {
 public:
  void tick(const record::TickInput& input, record::TickOutput& output);
};

}  // namespace firmtouch::app
