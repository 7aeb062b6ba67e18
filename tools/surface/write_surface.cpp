#include "surface/write_surface.hpp"

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

namespace firmtouch::tools {
namespace {

// %.9g whatever the locale says.
void append(std::string& text, float value) {
  char digits[32];
  const std::to_chars_result end = std::to_chars(
      digits, digits + sizeof digits, static_cast<double>(value), std::chars_format::general, 9);
  text.append(digits, end.ptr);
}

void append(std::string& text, math::Vec3 p, char between) {
  append(text, p.x);
  text += between;
  append(text, p.y);
  text += between;
  append(text, p.z);
  text += '\n';
}

}  // namespace

std::string to_obj(const Surface& surface) {
  std::string text = "# metres\n";
  for (const math::Vec3& v : surface.vertices) text += "v ", append(text, v, ' ');
  for (const Face& face : surface.faces) {
    text += "f " + std::to_string(face[0] + 1) + " " + std::to_string(face[1] + 1) + " " +
            std::to_string(face[2] + 1) + "\n";
  }
  return text;
}

namespace {

void append_faces(std::string& text, const std::vector<Face>& faces) {
  for (const Face& face : faces)
    text += "3 " + std::to_string(face[0]) + " " + std::to_string(face[1]) + " " +
            std::to_string(face[2]) + "\n";
}

template <class Number>
void append_bytes(std::string& bytes, Number value) {
  uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  for (size_t k = 0; k < sizeof value; ++k)
    bytes.push_back(static_cast<char>(bits >> 8 * k & 0xFF));
}

std::string to_stl(const Surface& surface) {
  std::string bytes = "binary STL, metres";
  bytes.resize(80);
  append_bytes(bytes, static_cast<uint32_t>(surface.faces.size()));
  for (const Face& face : surface.faces) {
    for (uint32_t k = 0; k < 3; ++k) append_bytes(bytes, 0.0f);  // readers take the winding
    for (const uint32_t v : face) {
      append_bytes(bytes, surface.vertices[v].x);
      append_bytes(bytes, surface.vertices[v].y);
      append_bytes(bytes, surface.vertices[v].z);
    }
    append_bytes(bytes, uint16_t{0});
  }
  return bytes;
}

}  // namespace

std::string to_model(const Surface& surface, const std::string& extension) {
  const std::string vertices = std::to_string(surface.vertices.size());
  const std::string faces = std::to_string(surface.faces.size());
  std::string text;
  if (extension == "obj") return to_obj(surface);
  if (extension == "stl") return to_stl(surface);
  if (extension == "off") text = "OFF\n# metres\n" + vertices + " " + faces + " 0\n";
  if (extension == "ply")
    text = "ply\nformat ascii 1.0\ncomment metres\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  if (text.empty()) return text;
  for (const math::Vec3& v : surface.vertices) append(text, v, ' ');
  append_faces(text, surface.faces);
  return text;
}

std::string to_csv(const std::vector<math::Vec3>& points_m) {
  std::string text = "x,y,z\n";
  for (const math::Vec3& p : points_m) append(text, p, ',');
  return text;
}

std::string write_text(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return path + ": cannot be written: " + std::strerror(errno);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = std::fclose(file) == 0;
  if (written && closed) return "";
  const std::string why = std::strerror(errno);
  std::remove(path.c_str());
  return path + ": cannot be written: " + why + "; is the disk full?";
}

}  // namespace firmtouch::tools
