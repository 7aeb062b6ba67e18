#include "surface/read/zip.hpp"

#include "firmtouch/core/crc32.hpp"

namespace firmtouch::tools {
namespace {

constexpr size_t kEndBytes = 22, kCentralBytes = 46, kLocalBytes = 30;

uint32_t number(std::string_view bytes, size_t at, uint32_t count) {
  uint32_t value = 0;
  for (uint32_t k = count; k-- > 0;) value = value << 8 | static_cast<uint8_t>(bytes[at + k]);
  return value;
}

}  // namespace

std::string list_zip(std::string_view bytes, std::vector<ZipEntry>& entries) {
  const size_t end = bytes.rfind(std::string_view("PK\x05\x06", 4));
  if (end == bytes.npos || bytes.size() - end < kEndBytes)
    return "has no directory: it is cut short";
  const uint32_t count = number(bytes, end + 10, 2);
  size_t at = number(bytes, end + 16, 4);
  if (count == 0xFFFF || at == 0xFFFFFFFF) return "is a zip64 archive, which is not read";
  for (uint32_t k = 0; k < count; ++k) {
    if (at > bytes.size() || bytes.size() - at < kCentralBytes ||
        bytes.substr(at, 4) != std::string_view("PK\x01\x02", 4))
      return "has a damaged directory";
    const uint32_t name = number(bytes, at + 28, 2);
    const size_t rest = size_t{name} + number(bytes, at + 30, 2) + number(bytes, at + 32, 2);
    if (bytes.size() - at - kCentralBytes < rest) return "has a damaged directory";
    if ((number(bytes, at + 8, 2) & 1) != 0) return "is encrypted";
    entries.push_back({bytes.substr(at + kCentralBytes, name), number(bytes, at + 10, 2),
                       number(bytes, at + 16, 4), number(bytes, at + 20, 4),
                       number(bytes, at + 24, 4), number(bytes, at + 42, 4)});
    at += kCentralBytes + rest;
  }
  return {};
}

Inflated unzip(std::string_view bytes, const ZipEntry& entry) {
  const size_t at = entry.local;
  if (at > bytes.size() || bytes.size() - at < kLocalBytes ||
      bytes.substr(at, 4) != std::string_view("PK\x03\x04", 4))
    return {{}, "its place is wrong", 0};
  const size_t head = kLocalBytes + size_t{number(bytes, at + 26, 2)} + number(bytes, at + 28, 2);
  if (bytes.size() - at < head || bytes.size() - at - head < entry.packed)
    return {{}, "it is cut short", 0};
  const std::string_view packed = bytes.substr(at + head, entry.packed);
  Inflated file;
  if (entry.method == 0) {
    file.bytes = std::string(packed);
  } else if (entry.method == 8) {
    file = inflate(packed, entry.size);
  } else {
    file.problem = "its compression (method " + std::to_string(entry.method) + ") is not read";
  }
  if (!file.problem.empty()) return file;
  const core::Bytes span(reinterpret_cast<const uint8_t*>(file.bytes.data()),
                         static_cast<uint32_t>(file.bytes.size()));
  if (file.bytes.size() != entry.size || core::crc32(span) != entry.crc)
    return {{}, "its check sum differs", 0};
  return file;
}

}  // namespace firmtouch::tools
