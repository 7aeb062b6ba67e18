#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/log.hpp"
#include "log/file_sink.hpp"

namespace firmtouch::host_sim {
namespace {

const std::string kStandardOutput = "-";

// `error`: of the system.
[[noreturn]] void fail_to_write(const std::string& path, int error) {
  const bool is_full = error == ENOSPC || error == EDQUOT;
  throw Refused(
      path + ": cannot be written: " + std::strerror(error) +
      (is_full ? "; free the disk, or name a file elsewhere" : "; name a file elsewhere"));
}

}  // namespace

std::string read_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_character_file(path, error))
    throw Refused(path + ": is a device, which may have no end; name a file");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  if (!in || std::filesystem::is_directory(path) || !(bytes << in.rdbuf()))
    if (!in || in.peek() != std::ifstream::traits_type::eof())
      throw Refused(path + ": cannot be read: " + std::strerror(errno));
  return bytes.str();
}

std::string partial_of(const std::string& path) {
  return log::is_special(path) ? path : path + ".partial";
}

void remove_partial(const std::string& path) {
  if (!log::is_special(path)) std::remove(partial_of(path).c_str());
}

void check_writable(const std::string& path) {
  if (path == kStandardOutput || log::is_special(path)) return;
  const std::string partial = partial_of(path);
  std::ofstream out(partial, std::ios::binary);
  if (!out) fail_to_write(path, errno);
  out.close();
  std::remove(partial.c_str());
}

void take_name(const std::string& path) {
  const std::string partial = partial_of(path);
  if (std::rename(partial.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  remove_partial(path);
  fail_to_write(path, error);
}

TextStream::TextStream(const std::string& path)
    : path_(path),
      file_(path == kStandardOutput ? stdout : std::fopen(partial_of(path).c_str(), "wb")) {
  if (file_ == nullptr) fail_to_write(path, errno);
}

TextStream::~TextStream() {
  if (file_ == nullptr || file_ == stdout) return;
  std::fclose(file_);
  remove_partial(path_);
}

void TextStream::add(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail_to_write(path_, errno);
}

void TextStream::finish() {
  std::FILE* const file = file_;
  file_ = file == stdout ? stdout : nullptr;
  if ((file == stdout ? std::fflush(file) : std::fclose(file)) != 0) {
    const int error = errno;
    if (file != stdout) remove_partial(path_);
    fail_to_write(path_, error);
  }
  if (file != stdout) take_name(path_);
}

void write_file(const std::string& path, const std::string& bytes) {
  TextStream out(path);
  out.add(bytes);
  out.finish();
}

}  // namespace firmtouch::host_sim
