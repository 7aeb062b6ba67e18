#pragma once
#include "firmtouch/core/bytes.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/device/layout.hpp"
#include "firmtouch/device/load.hpp"

// One of the linkages, as an asset stores it: read in place from flash, so that no flipped bit of
// RAM changes a link or a limit.
namespace firmtouch::device {

/// A part of a section of type kLinkageSection. Its open() proves it.
template <class Layout>
class StoredPart {
 public:
  bool is_open() const { return layout_ != nullptr; }
  /// Pre: is_open().
  const Layout& layout() const { return *layout_; }

 protected:
  const Layout* layout_ = nullptr;
};

class StoredLinkage : public StoredPart<LinkageLayout> {
 public:
  /// Pre of what follows: is_open().
  FiveBar five_bar() const;
  SerialArm serial_arm() const;
  Delta delta() const;
  JointSettings joints(VelocitySettings velocity) const;
  TorqueLimits limits() const;
  Load load() const;

 private:
  friend core::Verdict open(core::Bytes section, StoredLinkage& to);
};

/// A part that a section may have behind the linkage. Proving it takes what else is `Needed`.
template <class Layout, class... Needed>
class FurtherPart : public StoredPart<Layout> {
 public:
  /// What is before it in a section of type kLinkageSection.
  static core::Bytes before(core::Bytes section) {
    return Layout::is_in(section) ? core::Bytes{section.data(), rest_of(section)} : section;
  }

  /// Proves it. It is open only where the section has it and the verdict is passed. The bytes must
  /// outlive it. Pre: `linkage` and `needed` are open, of this section. Bounds: constant.
  core::Verdict open(core::Bytes section, const StoredLinkage& linkage, const Needed&... needed) {
    this->layout_ = nullptr;
    if (!Layout::is_in(section)) return core::kPassed;
    this->layout_ =
        core::as_array<Layout>({section.data() + rest_of(section), sizeof(Layout)}, 1).data();
    const core::Verdict verdict = check(section, linkage, needed...);
    if (!verdict.ok()) this->layout_ = nullptr;
    return verdict;
  }

 private:
  static uint32_t rest_of(core::Bytes section) { return section.size() - uint32_t{sizeof(Layout)}; }
  core::Verdict check(core::Bytes section, const StoredLinkage& linkage,
                      const Needed&... needed) const;
};

/// Proves a section of type kLinkageSection; `to` is open where the verdict is passed. The bytes
/// must outlive it. Bounds: constant.
core::Verdict open(core::Bytes section, StoredLinkage& to);

/// As those of the linkage that is stored. Pre: linkage.is_open().
Pose pose_of(const StoredLinkage& linkage, const float (&angle_rad)[kMaxJoints]);
math::Vec3 carrying_torques_Nm(const StoredLinkage& linkage, const float (&angle_rad)[kMaxJoints],
                               const Pose& pose);

}  // namespace firmtouch::device
