#include <array>
#include <cstring>

#include "firmtouch/mesh/layout.hpp"
#include "surface/read/import_sink.hpp"
#include "surface/read/json.hpp"
#include "surface/read/load_file.hpp"

// glTF 2.0 and its binary form GLB: JSON that names buffers of numbers. The triangles of every mesh
// that the scene's nodes place are taken; skins, morphs and materials are passed over.
// Source: Khronos glTF 2.0 specification.

namespace firmtouch::tools {
namespace {

constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int64_t kFloat = 5126;

uint32_t word(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (uint32_t k = 4; k-- > 0;) value = value << 8 | static_cast<uint8_t>(bytes[at + k]);
  return value;
}

bool decode_base64(std::string_view text, std::string& out) {
  uint32_t held = 0, bits = 0;
  for (const char c : text) {
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=') break;
    if (c == '\\') continue;  // JSON may escape a slash
    const size_t digit = kDigits.find(c);
    if (digit == kDigits.npos) return false;
    held = (held << 6 | static_cast<uint32_t>(digit)) & 0xFFFFFF;
    bits += 6;
    if (bits >= 8) out.push_back(static_cast<char>(held >> (bits -= 8) & 0xFF));
  }
  return true;
}

using Matrix = std::array<double, 16>;  // column after column
constexpr Matrix kAsItIs = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (size_t col = 0; col < 4; ++col)
    for (size_t row = 0; row < 4; ++row)
      for (size_t k = 0; k < 4; ++k) c[4 * col + row] += a[4 * k + row] * b[4 * col + k];
  return c;
}

struct Numbers {  // an accessor
  std::string_view bytes;
  int64_t count = 0, stride = 0, type = 0;
};

class Scene {
 public:
  Scene(std::string_view json, std::string_view binary, ImportSink& sink)
      : text_(json), binary_(binary), sink_(sink) {}

  bool read() {
    const std::string problem = json_.parse(text_);
    if (!problem.empty()) return sink_.fail(problem);
    if (!refuse_extensions()) return false;
    views_ = list("bufferViews");
    accessors_ = list("accessors");
    meshes_ = list("meshes");
    nodes_ = list("nodes");
    return read_buffers() && place();
  }

 private:
  std::vector<uint32_t> list(const char* name) const {
    return json_.items(json_.member(json_.root(), name));
  }
  int64_t whole(uint32_t object, const char* name, int64_t otherwise) const {
    return json_.whole(json_.member(object, name), otherwise);
  }

  bool refuse_extensions() {
    for (const uint32_t name : list("extensionsRequired")) {
      const std::string_view text = json_.text(name);
      if (text.find("draco") != text.npos || text.find("meshopt") != text.npos ||
          text.find("quantization") != text.npos)
        return sink_.fail("needs " + quoted(text) +
                          ", which is not read: export it without compression");
    }
    return true;
  }

  bool read_buffers() {
    const std::vector<uint32_t> buffers = list("buffers");
    for (size_t i = 0; i < buffers.size(); ++i) {
      const std::string_view uri = json_.text(json_.member(buffers[i], "uri"));
      const std::string name = "buffer " + std::to_string(i);
      std::string bytes;
      if (uri.empty() && i == 0) {
        bytes = std::string(binary_);
      } else if (uri.substr(0, 5) == "data:") {
        const size_t comma = uri.find(";base64,");
        if (comma == uri.npos || !decode_base64(uri.substr(comma + 8), bytes))
          return sink_.fail(name + " holds no base64 text: export it again");
      } else if (uri.empty() || uri.find_first_of("/\\:%") != uri.npos) {
        return sink_.fail(name + " is not beside the file: export it as .glb");
      } else {
        LoadedFile file = load_file(sink_.folder() + std::string(uri), SIZE_MAX);
        if (!file.problem.empty())
          return sink_.fail(name + ", " + quoted(uri) + ", " + file.problem +
                            "; or export it as .glb");
        bytes.assign(file.bytes.begin(), file.bytes.end());
      }
      buffers_.push_back(std::move(bytes));
    }
    return true;
  }

  // `parts`: numbers of one element; `type`: what they must be, 0: a whole number without sign.
  bool find_numbers(int64_t accessor, int64_t parts, int64_t type, Numbers& found) {
    const std::string name = "accessor " + std::to_string(accessor);
    if (accessor < 0 || accessor >= static_cast<int64_t>(accessors_.size()))
      return sink_.fail(name + " is missing: export it again");
    const uint32_t a = accessors_[static_cast<size_t>(accessor)];
    if (json_.member(a, "sparse") != JsonReader::kNoValue)
      return sink_.fail(name + " is sparse, which is not read: export it without");
    found.type = whole(a, "componentType", -1);
    found.count = whole(a, "count", -1);
    const bool is_whole = found.type == 5121 || found.type == 5123 || found.type == 5125;
    if (json_.text(json_.member(a, "type")) != (parts == 3 ? "VEC3" : "SCALAR") ||
        (type != 0 ? found.type != type : !is_whole))
      return sink_.fail(name + " holds other numbers than it should: export it again");
    const int64_t size = parts * (found.type == 5121 ? 1 : found.type == 5123 ? 2 : 4);
    const int64_t view = whole(a, "bufferView", -1);
    if (view < 0 || view >= static_cast<int64_t>(views_.size()))
      return sink_.fail(name + " has no bufferView: export it again");
    const uint32_t v = views_[static_cast<size_t>(view)];
    const int64_t buffer = whole(v, "buffer", -1), begin = whole(v, "byteOffset", 0),
                  length = whole(v, "byteLength", -1), offset = whole(a, "byteOffset", 0);
    found.stride = whole(v, "byteStride", size);
    const bool has_buffer = buffer >= 0 && buffer < static_cast<int64_t>(buffers_.size());
    const int64_t held =
        has_buffer ? static_cast<int64_t>(buffers_[static_cast<size_t>(buffer)].size()) : 0;
    if (!has_buffer || begin < 0 || length < 0 || begin > held || length > held - begin ||
        offset < 0 || offset > length || found.count < 0 || found.stride < size ||
        found.stride > 65536 || found.count > length ||
        (found.count > 0 && (found.count - 1) * found.stride + size > length - offset))
      return sink_.fail(name +
                        " reaches beyond its buffer: the file is cut short; export it again");
    found.bytes =
        std::string_view(buffers_[static_cast<size_t>(buffer)])
            .substr(static_cast<size_t>(begin + offset), static_cast<size_t>(length - offset));
    return true;
  }

  static int64_t index_at(const Numbers& numbers, int64_t i) {
    const size_t at = static_cast<size_t>(i * numbers.stride);
    if (numbers.type == 5125) return word(numbers.bytes, at);
    const int64_t low = static_cast<uint8_t>(numbers.bytes[at]);
    return numbers.type == 5121 ? low
                                : low | int64_t{static_cast<uint8_t>(numbers.bytes[at + 1])} << 8;
  }

  bool add_primitive(uint32_t primitive, const Matrix& m, const Place& place) {
    const int64_t mode = whole(primitive, "mode", 4);
    if (mode < 4 || mode > 6) {
      ++passed_over_;
      return true;
    }
    Numbers points, indices;
    const uint32_t attributes = json_.member(primitive, "attributes");
    if (!find_numbers(whole(attributes, "POSITION", -1), 3, kFloat, points)) return false;
    const int64_t list = whole(primitive, "indices", -1);
    if (list >= 0 && !find_numbers(list, 1, 0, indices)) return false;
    const int64_t first = static_cast<int64_t>(sink_.vertex_count());
    if (first + points.count > 3 * int64_t{mesh::kMaxTriangles})
      return sink_.fail(place, "more vertices than an asset holds: simplify the model");
    for (int64_t i = 0; i < points.count; ++i) {
      double p[3], xyz[3];
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t bits = word(points.bytes, static_cast<size_t>(i * points.stride) + 4 * k);
        float value = 0;
        std::memcpy(&value, &bits, sizeof value);
        p[k] = static_cast<double>(value);
      }
      for (size_t k = 0; k < 3; ++k)
        xyz[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
      if (!sink_.add_vertex(xyz, place)) return false;
    }
    const double det = m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) +
                       m[8] * (m[1] * m[6] - m[5] * m[2]);
    const int64_t count = list >= 0 ? indices.count : points.count;
    const auto corner = [&](int64_t i) {
      const int64_t v = list >= 0 ? index_at(indices, i) : i;
      return v < points.count ? first + v : -1;
    };
    std::vector<int64_t> face(3);
    for (int64_t i = 2; i < count; i += mode == 4 ? 3 : 1) {
      face = {corner(mode == 6 ? 0 : i - 2), corner(i - 1), corner(i)};
      if ((mode == 5 && i % 2 == 1) != (det < 0)) std::swap(face[1], face[2]);
      if (!sink_.add_polygon(face, place)) return false;
    }
    return true;
  }

  // The nodes from the scene's roots on: each is entered once, so that a ring of them ends.
  bool place() {
    struct Pending {
      uint32_t node;
      Matrix above;
    };
    std::vector<Pending> pending;
    std::vector<bool> is_child(nodes_.size(), false), is_placed(nodes_.size(), false);
    for (const uint32_t node : nodes_)
      for (const uint32_t child : json_.items(json_.member(node, "children"))) {
        const int64_t c = json_.whole(child, -1);
        if (c >= 0 && c < static_cast<int64_t>(nodes_.size()))
          is_child[static_cast<size_t>(c)] = true;
      }
    const std::vector<uint32_t> scenes = list("scenes");
    const int64_t chosen = whole(json_.root(), "scene", 0);
    if (chosen >= 0 && chosen < static_cast<int64_t>(scenes.size())) {
      for (const uint32_t root :
           json_.items(json_.member(scenes[static_cast<size_t>(chosen)], "nodes")))
        pending.push_back({static_cast<uint32_t>(json_.whole(root, -1)), kAsItIs});
    } else {
      for (uint32_t n = 0; n < nodes_.size(); ++n)
        if (!is_child[n]) pending.push_back({n, kAsItIs});
    }
    while (!pending.empty()) {
      const Pending now = pending.back();
      pending.pop_back();
      if (now.node >= nodes_.size())
        return sink_.fail("the scene names a node that is missing: export it again");
      if (is_placed[now.node]) continue;
      is_placed[now.node] = true;
      const uint32_t node = nodes_[now.node];
      const Matrix m = product(now.above, matrix_of(node));
      const int64_t mesh = whole(node, "mesh", -1);
      if (mesh >= 0 && !add_mesh(mesh, m)) return false;
      for (const uint32_t child : json_.items(json_.member(node, "children")))
        pending.push_back({static_cast<uint32_t>(json_.whole(child, -1)), m});
    }
    if (passed_over_ != 0)
      sink_.note("passed over " + std::to_string(passed_over_) + " primitives of points or lines");
    return true;
  }

  bool add_mesh(int64_t mesh, const Matrix& m) {
    if (mesh >= static_cast<int64_t>(meshes_.size()))
      return sink_.fail("a node names mesh " + std::to_string(mesh) +
                        ", which is missing: export it again");
    const uint32_t object = meshes_[static_cast<size_t>(mesh)];
    const std::vector<uint32_t> primitives = json_.items(json_.member(object, "primitives"));
    primitives_ += primitives.size() + 1;
    if (primitives_ > mesh::kMaxTriangles)
      return sink_.fail("places more primitives than an asset has triangles: simplify it");
    for (const uint32_t primitive : primitives)
      if (!add_primitive(primitive, m, {0, 0, "mesh", static_cast<uint64_t>(mesh)}) ||
          sink_.failed())
        return false;
    return true;
  }

  Matrix matrix_of(uint32_t node) const {
    Matrix m = kAsItIs;
    const auto fill = [&](const char* name, size_t count, double* to) {
      const std::vector<uint32_t> items = json_.items(json_.member(node, name));
      for (size_t k = 0; k < count && items.size() == count; ++k)
        to[k] = json_.number(items[k], to[k]);
    };
    fill("matrix", 16, m.data());
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    fill("translation", 3, t);
    fill("rotation", 4, q);
    fill("scale", 3, s);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const Matrix placed = {s[0] * (1 - 2 * (y * y + z * z)),
                           s[0] * 2 * (x * y + z * w),
                           s[0] * 2 * (x * z - y * w),
                           0,
                           s[1] * 2 * (x * y - z * w),
                           s[1] * (1 - 2 * (x * x + z * z)),
                           s[1] * 2 * (y * z + x * w),
                           0,
                           s[2] * 2 * (x * z + y * w),
                           s[2] * 2 * (y * z - x * w),
                           s[2] * (1 - 2 * (x * x + y * y)),
                           0,
                           t[0],
                           t[1],
                           t[2],
                           1};
    return product(m, placed);
  }

  std::string_view text_, binary_;
  ImportSink& sink_;
  JsonReader json_;
  std::vector<std::string> buffers_;
  std::vector<uint32_t> views_, accessors_, meshes_, nodes_;
  size_t primitives_ = 0;
  uint32_t passed_over_ = 0;
};

}  // namespace

void read_gltf(std::string_view bytes, ImportSink& sink) {
  std::string_view json = bytes, binary;
  if (bytes.substr(0, 4) == "glTF") {
    json = {};
    if (bytes.size() < 12 || word(bytes, 4) != 2) {
      sink.fail("is no glTF of version 2: export it again");
      return;
    }
    for (size_t at = 12; bytes.size() - at >= 8;) {
      const size_t length = word(bytes, at);
      const uint32_t type = word(bytes, at + 4);
      if (bytes.size() - at - 8 < length) {
        sink.fail("the file ends inside a chunk: it is cut short; export it again");
        return;
      }
      const std::string_view chunk = bytes.substr(at + 8, length);
      if (type == kJsonChunk && json.empty()) json = chunk;
      if (type == kBinaryChunk && binary.empty()) binary = chunk;
      at += 8 + length;
    }
  }
  Scene(json, binary, sink).read();
}

}  // namespace firmtouch::tools
