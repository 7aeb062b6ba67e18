#pragma once

namespace firmtouch::log {

/// Base of abstract classes, which are neither copied nor moved.
class Interface {
 public:
  Interface() = default;
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  virtual ~Interface() = default;
};

}  // namespace firmtouch::log
