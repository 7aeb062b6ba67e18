#pragma once
#include <stdint.h>

#include "firmtouch/controller/loaders.hpp"
#include "firmtouch/controller/model.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"

namespace firmtouch::target {

/// A wall 2 mm above the tool's centre whose query takes as long as busy_until_us() says. It needs
/// no section of an asset.
class BusySurface : public asset::LoadsNothing {
 public:
  using Parameters = params::Groups<params::ContactRows>;
  static constexpr bool kIsGuide = false;
  static constexpr uint32_t kParts = 0;

  static const char* find(const asset::Container&, const char*) { return "busy"; }
  void reset() {}
  bool is_open() const { return true; }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
};

}  // namespace firmtouch::target
