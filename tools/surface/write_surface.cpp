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
