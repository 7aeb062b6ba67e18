#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "log/interface.hpp"

namespace firmtouch::log {

/// The bytes that a reader reads: a file, or memory.
class Source : public Interface {
 public:
  virtual uint64_t size() const = 0;
  /// Pre: offset + bytes <= size(). Result: false where they cannot be read.
  virtual bool read(uint64_t offset, void* to, uint64_t bytes) = 0;
};

/// Throws std::runtime_error naming the file where it cannot be opened.
std::unique_ptr<Source> open_file(const std::string& path);
/// `bytes` must outlive it.
std::unique_ptr<Source> over_memory(const std::vector<uint8_t>& bytes);

}  // namespace firmtouch::log
