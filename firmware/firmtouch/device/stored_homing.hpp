#pragma once
#include "firmtouch/device/homing.hpp"
#include "firmtouch/device/stored_linkage.hpp"

namespace firmtouch::device {

/// How the linkage of an asset is homed, as it stores it.
class StoredHoming {
 public:
  /// False: the counts are those of the joints from the beginning.
  bool is_open() const { return layout_ != nullptr; }
  /// Pre of what follows: is_open().
  const HomingLayout& layout() const { return *layout_; }
  HomingSettings settings() const;

 private:
  friend core::Verdict open(core::Bytes section, StoredLinkage& linkage, StoredHoming& homing);
  const HomingLayout* layout_ = nullptr;
};

/// Proves a section of type kLinkageSection with or without homing. Both are open only where the
/// verdict is passed. The bytes must outlive them. Bounds: constant.
core::Verdict open(core::Bytes section, StoredLinkage& linkage, StoredHoming& homing);

}  // namespace firmtouch::device
