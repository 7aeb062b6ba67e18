#pragma once
#include <stdint.h>

#include "firmtouch/controller/loaders.hpp"
#include "firmtouch/controller/model.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"

namespace firmtouch::target {

/// A wall 2 mm above the tool's centre whose query takes as long as busy_until_us() says. It needs
/// no section of an asset.
class BusySurface {
 public:
  using Parameters = params::Groups<params::ContactRows>;
  using State = core::OneOf<uint32_t>;
  static constexpr bool kIsGuide = false;
  static constexpr uint32_t kParts = 0;

  static const char* find(const asset::Container&, const char*) { return "busy"; }
  void reset() {}
  void close() {}
  template <class Trust>
  void begin(const asset::Container&, const char*, State&) {}
  template <class Trust>
  asset::Progress work(State&, uint32_t) {
    return {true, core::kPassed};
  }
  bool is_open() const { return true; }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
};

}  // namespace firmtouch::target
