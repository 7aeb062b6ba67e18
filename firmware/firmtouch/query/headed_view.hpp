#pragma once

namespace firmtouch::query {

/// What the views of all geometries share.
template <class HeadOf, class SectionsOf>
class HeadedView {
 public:
  using Sections = SectionsOf;
  bool is_open() const { return head_ != nullptr; }
  const HeadOf& head() const { return *head_; }

 protected:
  const HeadOf* head_ = nullptr;
};

}  // namespace firmtouch::query
