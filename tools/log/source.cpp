#include "log/source.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace firmtouch::log {
namespace {

class FileSource : public Source {
 public:
  explicit FileSource(const std::string& path) {
    errno = 0;
    if (!std::filesystem::is_directory(path)) in_.open(path, std::ios::binary | std::ios::ate);
    if (!in_.is_open() || !in_)
      throw std::runtime_error(
          path + ": cannot be read: " + (errno == 0 ? "it is a folder" : std::strerror(errno)));
    size_ = static_cast<uint64_t>(in_.tellg());
  }
  uint64_t size() const override { return size_; }
  bool read(uint64_t offset, void* to, uint64_t bytes) override {
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(offset));
    in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    return static_cast<uint64_t>(in_.gcount()) == bytes;
  }

 private:
  std::ifstream in_;
  uint64_t size_ = 0;
};

class MemorySource : public Source {
 public:
  explicit MemorySource(const std::vector<uint8_t>& bytes) : bytes_(bytes) {}
  uint64_t size() const override { return bytes_.size(); }
  bool read(uint64_t offset, void* to, uint64_t bytes) override {
    if (bytes > 0) std::memcpy(to, bytes_.data() + offset, bytes);
    return true;
  }

 private:
  const std::vector<uint8_t>& bytes_;
};

}  // namespace

std::unique_ptr<Source> open_file(const std::string& path) {
  return std::make_unique<FileSource>(path);
}

std::unique_ptr<Source> over_memory(const std::vector<uint8_t>& bytes) {
  return std::make_unique<MemorySource>(bytes);
}

}  // namespace firmtouch::log
