#pragma once
#include <cstdint>
#include <vector>

#include "log/sink.hpp"

namespace firmtouch::log {

/// A log in memory: for small ones that are written whole, and for tests.
class MemorySink : public Sink {
 public:
  bool write(uint64_t offset, Part first, Part second) override {
    const uint64_t end = offset + first.bytes + second.bytes;
    if (bytes_.size() < end) bytes_.resize(end);
    put(offset, first);
    put(offset + first.bytes, second);
    return true;
  }
  void reserve(uint64_t) override {}
  bool sync() override { return true; }
  bool end_at(uint64_t bytes) override {
    bytes_.resize(bytes);
    return true;
  }
  std::string problem() const override { return "out of memory"; }
  std::vector<uint8_t>& bytes() { return bytes_; }

 private:
  void put(uint64_t offset, Part part) {
    const uint8_t* from = static_cast<const uint8_t*>(part.data);
    for (uint64_t i = 0; i < part.bytes; ++i) bytes_[offset + i] = from[i];
  }
  std::vector<uint8_t> bytes_;
};

}  // namespace firmtouch::log
