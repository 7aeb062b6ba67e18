#include "cli/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "cli/failure.hpp"

namespace firmtouch::cli {
namespace {

std::string reason() { return std::strerror(errno); }

struct File {
  explicit File(std::FILE* opened) : handle(opened) {}
  ~File() {
    if (handle != nullptr) std::fclose(handle);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::FILE* handle;
};

}  // namespace

std::vector<uint8_t> read_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail_input(path + ": is a folder; name a file");
  const File file(std::fopen(path.c_str(), "rb"));
  if (file.handle == nullptr) fail_input(path + ": cannot be opened: " + reason());
  std::vector<uint8_t> bytes;
  uint8_t block[65536];
  size_t count = 0;
  while ((count = std::fread(block, 1, sizeof(block), file.handle)) > 0) {
    bytes.insert(bytes.end(), block, block + count);
  }
  if (std::ferror(file.handle) != 0) fail_input(path + ": cannot be read: " + reason());
  return bytes;
}

void write_file(const std::string& path, const void* bytes, size_t count) {
  const std::string temporary = path + ".part";
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr)
    fail_input(path + ": cannot be written: " + reason() + "; name a folder that exists with -o");
  const bool written = std::fwrite(bytes, 1, count, file) == count;
  const bool closed = std::fclose(file) == 0;
  if (written && closed && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const std::string why = reason();
  std::remove(temporary.c_str());
  fail_input(path + ": cannot be written: " + why);
}

std::string stem_of(const std::string& path) { return std::filesystem::path(path).stem().string(); }

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& letter : extension) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return extension;
}

std::string file_name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void forbid_overwriting(const std::string& output, const std::string& input) {
  std::error_code error;
  if (std::filesystem::equivalent(output, input, error) && !error) {
    fail_usage("-o " + output + " would overwrite the input " + input + "; name another file");
  }
}

}  // namespace firmtouch::cli
