#pragma once
// The cube of shapes.hpp as text and bytes of every format. Quads fan to the very triangles of
// cube().
#include <cstring>
#include <string>

namespace firmtouch::tools {

inline const char* const kQuads[6] = {"0 2 3 1", "4 5 7 6", "0 1 5 4",
                                      "2 6 7 3", "0 4 6 2", "1 3 7 5"};
inline const char* const kCorners[8] = {"-1 -1 -1", "1 -1 -1", "-1 1 -1", "1 1 -1",
                                        "-1 -1 1",  "1 -1 1",  "-1 1 1",  "1 1 1"};
inline const int kQuadCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

/// `corner` writes the corner of a face from an index that counts from 0.
template <class Corner>
std::string cube_obj(const char* vertex_end, const char* line_end, Corner corner) {
  std::string text = std::string("# a cube") + line_end + "o thing" + line_end;
  for (const char* c : kCorners) text += std::string("v ") + c + vertex_end + line_end;
  text += std::string("vt 0 0") + line_end + "vn 0 0 1" + line_end + "usemtl a#b" + line_end +
          "s off" + line_end;
  for (const auto& quad : kQuadCorners) {
    text += "f";
    for (const int v : quad) text += " " + corner(v);
    text += line_end;
  }
  return text;
}
inline std::string cube_obj() {
  return cube_obj("", "\n", [](int v) { return std::to_string(v + 1); });
}

inline std::string cube_off(const char* head = "OFF\n8 6 12\n", const char* vertex_end = "\n",
                            const char* face_end = "\n") {
  std::string text = head;
  for (const char* c : kCorners) text += std::string(c) + vertex_end;
  for (const char* q : kQuads) text += std::string("4 ") + q + face_end;
  return text;
}

inline std::string cube_ply_ascii() {
  std::string text =
      "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 8\nproperty double x\nproperty "
      "uchar red\n"
      "property float y\nproperty float z\nelement edge 1\nproperty int vertex1\nproperty int "
      "vertex2\n"
      "element face 6\nproperty list uchar int vertex_indices\nproperty list uchar float "
      "texcoord\nend_header\n";
  for (const char* c : kCorners) {
    const std::string corner = c;
    text += corner.substr(0, corner.find(' ')) + " 255" + corner.substr(corner.find(' ')) + "\n";
  }
  text += "0 1\n";
  for (const char* q : kQuads) text += std::string("4 ") + q + " 2 0.5 0.25\n";
  return text;
}

class Bytes {
 public:
  explicit Bytes(bool is_big) : is_big_(is_big) {}
  template <class T>
  void put(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof value);
    for (size_t k = 0; k < sizeof(T); ++k) text += bytes[is_big_ ? sizeof(T) - 1 - k : k];
  }
  std::string text;

 private:
  bool is_big_;
};

/// Faces before vertices, shuffled properties of several types, lists to pass over, CRLF in the
/// header.
inline std::string cube_ply_binary(bool is_big) {
  Bytes out(is_big);
  out.text =
      std::string("ply\r\nformat ") + (is_big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\r\nelement face 6\r\nproperty char flag\r\nproperty list ushort ushort vertex_index\r\n"
      "element vertex 8\r\nproperty short z\r\nproperty list uint double weights\r\nproperty float "
      "x\r\n"
      "property double y\r\nend_header\r\n";
  for (const auto& quad : kQuadCorners) {
    out.put(static_cast<int8_t>(-1));
    out.put(static_cast<uint16_t>(4));
    for (const int v : quad) out.put(static_cast<uint16_t>(v));
  }
  for (int k = 0; k < 8; ++k) {
    out.put(static_cast<int16_t>((k & 4) != 0 ? 1 : -1));
    out.put(static_cast<uint32_t>(k));
    for (int w = 0; w < k; ++w) out.put(0.5);
    out.put((k & 1) != 0 ? 1.0f : -1.0f);
    out.put((k & 2) != 0 ? 1.0 : -1.0);
  }
  return out.text;
}

/// The twelve triangles of cube() with their normals; `end` ends every line.
inline std::string cube_stl_text(const char* name = "a cube", const char* end = "\n") {
  std::string text = std::string("solid ") + name + end;
  for (int f = 0; f < 12; ++f) {
    const int* quad = kQuadCorners[f / 2];
    const int corners[3] = {quad[0], quad[1 + f % 2], quad[2 + f % 2]};
    constexpr const char* kNormals[6] = {"0 0 -1", "0 0 1", "0 -1 0", "0 1 0", "-1 0 0", "1 0 0"};
    text += std::string("  facet normal ") + kNormals[f / 2] + end + "    outer loop" + end;
    for (const int v : corners) text += std::string("      vertex ") + kCorners[v] + end;
    text += std::string("    endloop") + end + "  endfacet" + end;
  }
  return text + "endsolid " + name + end;
}

/// `header` fills the first 80 bytes as far as it goes; `attribute` stands behind every facet.
inline std::string cube_stl_binary(const std::string& header = "", uint16_t attribute = 0) {
  Bytes out(false);
  out.text = header.substr(0, 80);
  out.text.resize(80, '\0');
  out.put(uint32_t{12});
  for (int f = 0; f < 12; ++f) {
    const int* quad = kQuadCorners[f / 2];
    const int corners[3] = {quad[0], quad[1 + f % 2], quad[2 + f % 2]};
    constexpr float kNormals[6][3] = {{0, 0, -1}, {0, 0, 1},  {0, -1, 0},
                                      {0, 1, 0},  {-1, 0, 0}, {1, 0, 0}};
    for (const float n : kNormals[f / 2]) out.put(n);
    for (const int v : corners) {
      for (int k = 0; k < 3; ++k) out.put((v >> k & 1) != 0 ? 1.0f : -1.0f);
    }
    out.put(attribute);
  }
  return out.text;
}

}  // namespace firmtouch::tools
