#pragma once
// Containers of models: a deflated 3MF body as gzip wrote it, zip archives and GLB made by hand.
#include <cstdint>
#include <cstring>
#include <string>

#include "firmtouch/core/crc32.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Of gzip -9: a 3MF model that places two of the cube of shapes.hpp, in millimetres, twice as
/// large, 20 mm apart and 5 mm up.
inline const char* const kModelGzip =
    "1f8b08000000000002037d93c17283201086ef790a867b42c4a47632606e7d81360f6074d3d011c80066"
    "923e7d116cd5263a1e76f563f97fdc85ed6fb24657305668c571b25a6304aad495509f1c1f3ede96af78"
    "9f2f98d415d4a851c2712c455d0b090e0c46be7a5717ed5a50cbc37bf8a02cc767e72e3b426c790659d8"
    "9514a5d1569fdcaad492a4952c54732a4ad718af434a6d80d075b2256b8abd9801ab1b5382cd993e7e41"
    "e990a8bc378cdcfd025ebff5827326c19e73e6bd3bd1ae5d84146ee8c6f1d22fbec7f01d02c907741676"
    "a5739503362d3aa7392739a31805c9df899933c2fffb3a1cfe3747d78463dfc52be598fa90729cb65b3e"
    "e369e4c903df44be8d3c9be259e42fc1d73381242ed84e19e804360f9c46fe3265808e0ca4930636bdc3"
    "a7bc13a00f3c19fda16c8a67fd017d67fa7e3012a793c401f67030c9f4ff24fb4b71d10a94b3831cc58a"
    "38fa640a20670a654fda48ff86d6e1e9631292b69a0c357a576470d78e8da8ab9c09077220414712b4db"
    "7a1c437f49574fc2a9f2c50f614077f95b040000";
inline std::string from_hex(const char* hex) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
  std::string bytes;
  for (; hex[0] != 0; hex += 2)
    bytes.push_back(static_cast<char>(digit(hex[0]) * 16 + digit(hex[1])));
  return bytes;
}

inline void append_number(std::string& to, uint32_t value, int bytes) {
  for (int k = 0; k < bytes; ++k, value = k < 4 ? value >> 8 : 0)
    to.push_back(static_cast<char>(value & 0xFF));
}

inline uint32_t crc_of(const std::string& bytes) {
  return core::crc32(
      {reinterpret_cast<const uint8_t*>(bytes.data()), static_cast<uint32_t>(bytes.size())});
}

/// A zip archive of one file. `method`: 0 stored, 8 deflated.
inline std::string zip_of(const std::string& name, const std::string& packed, uint32_t method,
                          uint32_t crc, uint32_t size) {
  const auto head = [&](uint32_t signature, bool is_central) {
    std::string bytes;
    append_number(bytes, signature, 4);
    if (is_central) append_number(bytes, 20, 2);
    append_number(bytes, 20, 2);
    append_number(bytes, 0, 2);
    append_number(bytes, method, 2);
    append_number(bytes, 0, 4);
    append_number(bytes, crc, 4);
    append_number(bytes, static_cast<uint32_t>(packed.size()), 4);
    append_number(bytes, size, 4);
    append_number(bytes, static_cast<uint32_t>(name.size()), 2);
    append_number(bytes, 0, is_central ? 16 : 2);
    return bytes + name;
  };
  std::string central = head(0x02014B50, true);
  std::string zip = head(0x04034B50, false) + packed;
  const uint32_t at = static_cast<uint32_t>(zip.size());
  zip += central;
  append_number(zip, 0x06054B50, 4);
  append_number(zip, 0, 4);
  append_number(zip, 1, 2);
  append_number(zip, 1, 2);
  append_number(zip, static_cast<uint32_t>(central.size()), 4);
  append_number(zip, at, 4);
  append_number(zip, 0, 2);
  return zip;
}

inline std::string cube_gltf_json(const char* buffer) {
  return std::string(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)") +
         R"("nodes":[{"children":[1]},{"mesh":0,"translation":[0,0,5],"scale":[2,2,2]}],)" +
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" +
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)" +
         R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],)" +
         R"("bufferViews":[{"buffer":0,"byteLength":96},)" +
         R"({"buffer":0,"byteOffset":96,"byteLength":72}],"buffers":[{)" + buffer +
         R"("byteLength":168}]})";
}

inline std::string cube_gltf_bytes(const Surface& cube) {
  std::string bytes;
  for (const math::Vec3& v : cube.vertices)
    for (const float x : {v.x, v.y, v.z}) {
      uint32_t bits = 0;
      std::memcpy(&bits, &x, 4);
      append_number(bytes, bits, 4);
    }
  for (const Face& face : cube.faces)
    for (const uint32_t v : face) append_number(bytes, v, 2);
  return bytes;
}

inline std::string glb_of(std::string json, const std::string& binary) {
  while (json.size() % 4 != 0) json += ' ';
  std::string glb = "glTF";
  append_number(glb, 2, 4);
  append_number(glb, static_cast<uint32_t>(28 + json.size() + binary.size()), 4);
  append_number(glb, static_cast<uint32_t>(json.size()), 4);
  append_number(glb, 0x4E4F534A, 4);
  glb += json;
  append_number(glb, static_cast<uint32_t>(binary.size()), 4);
  append_number(glb, 0x004E4942, 4);
  return glb + binary;
}

}  // namespace firmtouch::tools
