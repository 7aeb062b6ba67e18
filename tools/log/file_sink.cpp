#include "log/file_sink.hpp"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace firmtouch::log {
namespace {

class FileSink : public Sink {
 public:
  FileSink(int file, std::string path) : file_(file), path_(std::move(path)) {}
  ~FileSink() override { ::close(file_); }

  bool write(uint64_t offset, Part first, Part second) override {
    while (first.bytes + second.bytes > 0) {
      const iovec parts[2] = {{const_cast<void*>(first.data), first.bytes},
                              {const_cast<void*>(second.data), second.bytes}};
      const ssize_t done = ::pwritev(file_, parts, 2, static_cast<off_t>(offset));
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0) return failed(done < 0 ? errno : ENOSPC);
      const uint64_t bytes = static_cast<uint64_t>(done);
      const uint64_t of_first = bytes < first.bytes ? bytes : first.bytes;
      advance(first, of_first);
      advance(second, bytes - of_first);
      offset += bytes;
    }
    return true;
  }
  void reserve(uint64_t bytes) override {
#if defined(__linux__)
    // Keeps the file's size: a log that was not closed ends behind its last block. If the file
    // system cannot reserve, writing goes on without.
    if (::fallocate(file_, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes)) != 0) return;
#else
    (void)bytes;
#endif
  }
  bool sync() override { return ::fdatasync(file_) == 0 || failed(errno); }
  bool end_at(uint64_t bytes) override {
    return ::ftruncate(file_, static_cast<off_t>(bytes)) == 0 || failed(errno);
  }
  std::string problem() const override { return problem_; }

 private:
  static void advance(Part& part, uint64_t bytes) {
    part.data = static_cast<const char*>(part.data) + bytes;
    part.bytes -= bytes;
  }
  bool failed(int error) {
    problem_ = path_ + ": " + std::strerror(error);
    return false;
  }

  int file_;
  std::string path_, problem_;
};

}  // namespace

bool is_special(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_other(path, error) && !error;
}

std::unique_ptr<Sink> make_file(const std::string& path, std::string& problem) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file >= 0) return std::make_unique<FileSink>(file, path);
  problem = path + ": cannot be written: " + std::strerror(errno);
  return nullptr;
}

}  // namespace firmtouch::log
