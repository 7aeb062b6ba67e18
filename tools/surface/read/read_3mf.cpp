#include <array>
#include <map>

#include "firmtouch/mesh/layout.hpp"
#include "surface/read/import_sink.hpp"
#include "surface/read/text_scan.hpp"
#include "surface/read/xml_scan.hpp"
#include "surface/read/zip.hpp"

// 3MF: a zip archive with a model in XML. Objects are meshes or groups of earlier objects; the
// build places them. What an object says beside its shape is passed over.
// Source: 3MF Core Specification 1.3.

namespace firmtouch::tools {
namespace {

constexpr uint32_t kMaxPlaced = 1000000;  // objects placed, groups included

/// A row vector times this: x' = x m[0] + y m[3] + z m[6] + m[9].
using Placing = std::array<double, 12>;
constexpr Placing kAsItIs = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

Placing after(const Placing& inner, const Placing& outer) {
  Placing both{};
  for (size_t row = 0; row < 4; ++row)
    for (size_t k = 0; k < 3; ++k) {
      for (size_t i = 0; i < 3; ++i) both[3 * row + k] += inner[3 * row + i] * outer[3 * i + k];
      if (row == 3) both[3 * row + k] += outer[9 + k];
    }
  return both;
}

struct Part {
  std::string object;
  Placing placing;
};
struct Object {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<int64_t, 3>> faces;
  std::vector<Part> parts;
  uint64_t byte = 0;
};

class Model {
 public:
  explicit Model(ImportSink& sink) : sink_(sink) {}

  bool read(std::string_view text) {
    XmlScan scan(text);
    XmlScan::Tag tag;
    bool has_end = false;
    while (scan.next(tag)) {
      if (tag.closes) {
        if (tag.name == "object") open_ = nullptr;
        has_end = has_end || tag.name == "model";
      } else if (!take(tag)) {
        return false;
      }
    }
    return has_end || sink_.fail("ends inside its model (no </model>): it is cut short");
  }

  // Groups are opened one after another: no recursion, and an end for groups that multiply.
  bool place() {
    std::vector<Part> pending(build_.rbegin(), build_.rend());
    if (build_.empty()) return sink_.fail("places no object in its build: export it again");
    for (uint32_t placed = 0; !pending.empty(); ++placed) {
      if (placed == kMaxPlaced || pending.size() > kMaxPlaced)
        return sink_.fail("places more than 1000000 objects: simplify it");
      const Part part = pending.back();
      pending.pop_back();
      const auto found = objects_.find(part.object);
      if (found == objects_.end())
        return sink_.fail("places object '" + part.object.substr(0, 40) + "', which it lacks");
      if (!add(found->second, part.placing) || sink_.failed()) return false;
      for (auto inner = found->second.parts.rbegin(); inner != found->second.parts.rend(); ++inner)
        pending.push_back({inner->object, after(inner->placing, part.placing)});
    }
    return true;
  }

 private:
  static Place at(const XmlScan::Tag& tag) { return {0, tag.byte}; }

  bool number(const XmlScan::Tag& tag, const char* name, double& value) {
    const std::string_view word = attribute(tag, name);
    const char* wrong = read_number(word, value);
    return wrong == nullptr || sink_.bad_word(at(tag), word, wrong);
  }
  bool index(const XmlScan::Tag& tag, const char* name, int64_t& value) {
    const std::string_view word = attribute(tag, name);
    const char* wrong = read_integer(word, value);
    return wrong == nullptr || sink_.bad_word(at(tag), word, wrong);
  }

  bool take_unit(const XmlScan::Tag& tag) {
    static constexpr struct {
      std::string_view name;
      double unit_m;
      const char* shown;
    } kUnits[] = {{"millimeter", 0.001, "mm"}, {"", 0.001, "mm"},      {"meter", 1, "m"},
                  {"centimeter", 0.01, "cm"},  {"inch", 0.0254, "in"}, {"foot", 0.3048, "ft"},
                  {"micron", 1e-6, "um"}};
    for (const auto& unit : kUnits) {
      if (attribute(tag, "unit") != unit.name) continue;
      sink_.take_unit(unit.unit_m, unit.shown);
      return true;
    }
    return sink_.fail(at(tag), quoted(attribute(tag, "unit")) + " is no unit of 3MF");
  }

  bool take_part(const XmlScan::Tag& tag, std::vector<Part>& parts) {
    if (!attribute(tag, "p:path").empty())
      return sink_.fail(at(tag),
                        "the model is spread over several files of the archive, which is "
                        "not read: export it as one");
    Part part{std::string(attribute(tag, "objectid")), kAsItIs};
    const std::string_view text = attribute(tag, "transform");
    if (!text.empty()) {
      TextScan scan(text);
      std::string_view word;
      for (double& value : part.placing) {
        if (!scan.find_word(word) || read_number(word, value) != nullptr)
          return sink_.fail(at(tag), "a transform that is not 12 numbers: export it again");
      }
    }
    parts.push_back(part);
    return true;
  }

  bool take(const XmlScan::Tag& tag) {
    if (tag.name == "model") return take_unit(tag);
    if (tag.name == "object") {
      const auto added = objects_.emplace(std::string(attribute(tag, "id")), Object{});
      if (!added.second)
        return sink_.fail(at(tag), "object " + quoted(attribute(tag, "id")) + " stands twice");
      open_ = &added.first->second;
      open_->byte = tag.byte;
      if (tag.is_empty) open_ = nullptr;
      return true;
    }
    if (tag.name == "item") return take_part(tag, build_);
    if (open_ == nullptr) return true;
    if (tag.name == "component") {
      const std::string_view id = attribute(tag, "objectid");
      const auto found = objects_.find(std::string(id));
      if (found == objects_.end() || &found->second == open_)
        return sink_.fail(at(tag), "a component names object " + quoted(id) +
                                       ", which does not stand before it: export it again");
      return take_part(tag, open_->parts);
    }
    if (tag.name == "vertex") {
      std::array<double, 3> xyz{};
      if (!number(tag, "x", xyz[0]) || !number(tag, "y", xyz[1]) || !number(tag, "z", xyz[2]))
        return false;
      open_->vertices.push_back(xyz);
    } else if (tag.name == "triangle") {
      std::array<int64_t, 3> face{};
      if (!index(tag, "v1", face[0]) || !index(tag, "v2", face[1]) || !index(tag, "v3", face[2]))
        return false;
      if (open_->faces.size() >= mesh::kMaxTriangles)
        return sink_.fail(at(tag), "more triangles than an asset holds: simplify the model");
      open_->faces.push_back(face);
    }
    return true;
  }

  bool add(const Object& object, const Placing& m) {
    const int64_t first = static_cast<int64_t>(sink_.vertex_count());
    const int64_t count = static_cast<int64_t>(object.vertices.size());
    const Place place{0, object.byte, "object", 0};
    if (object.faces.empty()) return true;
    if (sink_.vertex_count() + object.vertices.size() > 3 * size_t{mesh::kMaxTriangles})
      return sink_.fail(place, "more vertices than an asset holds: simplify the model");
    for (const auto& v : object.vertices) {
      double xyz[3];
      for (size_t k = 0; k < 3; ++k)
        xyz[k] = v[0] * m[k] + v[1] * m[3 + k] + v[2] * m[6 + k] + m[9 + k];
      if (!sink_.add_vertex(xyz, place)) return false;
    }
    // A mirrored part keeps its outside.
    const double det = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
                       m[2] * (m[3] * m[7] - m[4] * m[6]);
    std::vector<int64_t> corners(3);
    for (const auto& face : object.faces) {
      for (size_t k = 0; k < 3; ++k) {
        const int64_t corner = face[det < 0 ? 2 - k : k];
        corners[k] = corner < 0 || corner >= count ? -1 : first + corner;
      }
      if (!sink_.add_polygon(corners, place)) return false;
    }
    return true;
  }

  ImportSink& sink_;
  std::map<std::string, Object> objects_;
  std::vector<Part> build_;
  Object* open_ = nullptr;
};

}  // namespace

void read_3mf(std::string_view bytes, ImportSink& sink) {
  std::vector<ZipEntry> entries;
  const std::string problem = list_zip(bytes, entries);
  if (!problem.empty()) {
    sink.fail(problem + ": export it again");
    return;
  }
  const ZipEntry* chosen = nullptr;
  for (const ZipEntry& entry : entries) {
    const bool is_model =
        entry.name.size() > 6 && entry.name.substr(entry.name.size() - 6) == ".model";
    if (is_model && (chosen == nullptr || entry.name == "3D/3dmodel.model")) chosen = &entry;
  }
  if (chosen == nullptr) {
    sink.fail("is a zip archive without a .model: is it a 3MF file? Export it again");
    return;
  }
  const Inflated file = unzip(bytes, *chosen);
  if (!file.problem.empty()) {
    sink.fail(quoted(chosen->name) + " in the archive cannot be read: " + file.problem +
              "; export it again");
    return;
  }
  Model model(sink);
  if (model.read(file.bytes)) model.place();
}

}  // namespace firmtouch::tools
