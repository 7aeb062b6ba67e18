#pragma once
#include "firmtouch/device/homing.hpp"
#include "firmtouch/device/stored_linkage.hpp"

namespace firmtouch::device {

/// How the linkage of an asset is homed, as it stores it. Not open: the counts are those of the
/// joints from the beginning.
class StoredHoming : public StoredPart<HomingLayout> {
 public:
  /// Pre: is_open().
  HomingSettings settings() const;

 private:
  friend core::Verdict open(core::Bytes section, StoredLinkage& linkage, StoredHoming& homing);
};

/// Proves a section of type kLinkageSection with or without homing. Both are open only where the
/// verdict is passed. The bytes must outlive them. Bounds: constant.
core::Verdict open(core::Bytes section, StoredLinkage& linkage, StoredHoming& homing);

}  // namespace firmtouch::device
