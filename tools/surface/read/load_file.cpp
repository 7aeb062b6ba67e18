#include "surface/read/load_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "surface/read/inflate.hpp"

namespace firmtouch::tools {
namespace {

/// Watches the length of lines while a text comes in.
class LineWatch {
 public:
  explicit LineWatch(size_t max_bytes) : max_bytes_(max_bytes) {}

  // Result: false where a line is too long.
  bool take(const uint8_t* bytes, size_t count) {
    for (size_t i = 0; i < count && is_text_; ++i) {
      if (bytes[i] == 0) is_text_ = false;
      if (bytes[i] == '\n' || bytes[i] == '\r') {
        if (bytes[i] == '\n' || !is_after_return_) ++line_;
        length_ = 0;
      } else if (++length_ > max_bytes_) {
        return false;
      }
      is_after_return_ = bytes[i] == '\r';
    }
    return true;
  }
  uint64_t line() const { return line_; }

 private:
  size_t max_bytes_;
  size_t length_ = 0;
  uint64_t line_ = 1;
  bool is_text_ = true, is_after_return_ = false;
};

// What comes out of a gzip file: enough for the largest asset, and no trap for the memory.
constexpr size_t kMaxUnpackedBytes = size_t{1} << 30;

std::string too_long(uint64_t line, size_t max_line_bytes) {
  return "line " + std::to_string(line) + " is longer than " + std::to_string(max_line_bytes) +
         " bytes: this is no text of that format; break its lines, or export it again";
}

}  // namespace

std::string model_extension(const std::string& path) {
  std::string rest = path;
  for (int k = 0; k < 2; ++k) {
    const size_t dot = rest.find_last_of("./\\");
    if (dot == rest.npos || rest[dot] != '.') return "";
    std::string extension = rest.substr(dot + 1);
    for (char& c : extension) {
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    if (extension != "gz") return extension;
    rest.resize(dot);
  }
  return "";
}

LoadedFile load_stream(std::FILE* stream, size_t max_line_bytes) {
  LoadedFile file;
  LineWatch lines(max_line_bytes);
  uint8_t block[65536];
  size_t count = 0;
  while ((count = std::fread(block, 1, sizeof block, stream)) > 0) {
    if (!lines.take(block, count)) {
      return {{}, too_long(lines.line(), max_line_bytes)};
    }
    if (file.bytes.size() + count > kMaxFileBytes) {
      return {{},
              "is larger than " + std::to_string(kMaxFileBytes) +
                  " bytes, the most that is read: simplify or split it"};
    }
    file.bytes.insert(file.bytes.end(), block, block + count);
  }
  if (std::ferror(stream) != 0)
    return {{}, std::string("cannot be read: ") + std::strerror(errno) + "; check the disk"};
  const std::string_view packed(reinterpret_cast<const char*>(file.bytes.data()),
                                file.bytes.size());
  if (!is_gzip(packed)) return file;
  const Inflated plain = gunzip(packed, kMaxUnpackedBytes);
  if (!plain.problem.empty())
    return {{}, "cannot be decompressed: " + plain.problem + "; compress it again"};
  file.bytes.assign(plain.bytes.begin(), plain.bytes.end());
  LineWatch unpacked(max_line_bytes);
  if (!unpacked.take(file.bytes.data(), file.bytes.size()))
    return {{}, too_long(unpacked.line(), max_line_bytes)};
  return file;
}

LoadedFile load_file(const std::string& path, size_t max_line_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return {{}, "is a folder; name a file"};
  if (std::filesystem::is_character_file(path, error))
    return {{}, "is a device, which may have no end; name a file"};
  std::FILE* stream = std::fopen(path.c_str(), "rb");
  if (stream == nullptr) {
    return {{},
            std::string("cannot be opened: ") + std::strerror(errno) +
                "; check its name and that it may be read"};
  }
  LoadedFile file = load_stream(stream, max_line_bytes);
  std::fclose(stream);
  return file;
}

std::string extension_of(const std::string& path) {
  const size_t dot = path.find_last_of("./\\");
  if (dot == path.npos || path[dot] != '.') return "";
  std::string extension = path.substr(dot + 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace firmtouch::tools
