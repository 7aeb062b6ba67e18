#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "surface/read/import_sink.hpp"

namespace firmtouch::tools {

enum class PlyType : uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};

constexpr uint32_t ply_bytes(PlyType type) {
  constexpr uint32_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<uint32_t>(type)];
}
constexpr bool is_integer(PlyType type) { return type < PlyType::kFloat32; }

enum class PlyFormat : uint8_t { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of a list
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  size_t bytes = 0;    // where the body begins
  uint64_t lines = 0;  // before the body
};

/// Reads the header of a PLY file. Result: false with the sink's problem set where it is not
/// understood.
bool read_ply_header(std::string_view file, PlyHeader& header, ImportSink& sink);

}  // namespace firmtouch::tools
