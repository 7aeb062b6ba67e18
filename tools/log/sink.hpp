#pragma once
#include <cstdint>
#include <string>

#include "log/interface.hpp"

namespace firmtouch::log {

/// Where a log is written: a file, or what stands for one in a test. Every call may be slow; none
/// throws.
class Sink : public Interface {
 public:
  struct Part {
    const void* data;
    uint64_t bytes;
  };
  /// Writes `first`, then `second`, from byte `offset` on. Result: false where not all of it could
  /// be written; the same call is then made again later.
  virtual bool write(uint64_t offset, Part first, Part second) = 0;
  /// Has room put aside up to byte `bytes`, so that later writes find it. May do nothing.
  virtual void reserve(uint64_t bytes) = 0;
  /// What was written survives a power cut from now on.
  virtual bool sync() = 0;
  /// Cuts off what was reserved and not written.
  virtual bool end_at(uint64_t bytes) = 0;
  /// Of the last call that failed.
  virtual std::string problem() const = 0;
};

}  // namespace firmtouch::log
