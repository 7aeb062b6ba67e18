#include <cmath>
#include <cstring>

#include "firmtouch/mesh/layout.hpp"
#include "surface/read/import_sink.hpp"
#include "surface/read/ply_header.hpp"
#include "surface/read/text_scan.hpp"

// PLY: a header that names elements and their properties, then the values, as text or binary of
// either byte order. Faces are polygons or strips of
// triangles. Other elements, and properties other than x, y, z and
// the corner list, are passed over.

namespace firmtouch::tools {
namespace {

constexpr char kEnds[] = "the file ends here: it is cut short; export it again";

// The values of the body one after another, as double: that holds every type of PLY exactly.
class PlyValues {
 public:
  PlyValues(std::string_view file, const PlyHeader& header)
      : format_(header.format),
        file_(file),
        at_(header.bytes),
        from_(header.bytes),
        scan_(file.substr(header.bytes)),
        lines_(header.lines) {}

  // Result: nullptr, or what is wrong.
  const char* next(PlyType type, double& value) {
    if (format_ == PlyFormat::kAscii) {
      std::string_view word;
      if (!scan_.find_word(word)) return kEnds;
      word_ = word;
      return read_number(word, value);
    }
    const uint32_t size = ply_bytes(type);
    from_ = at_;
    if (file_.size() - at_ < size) return kEnds;
    unsigned char bytes[8] = {};  // least significant first
    for (uint32_t k = 0; k < size; ++k) {
      const uint32_t to = format_ == PlyFormat::kBigEndian ? size - 1 - k : k;
      bytes[to] = static_cast<unsigned char>(file_[at_ + k]);
    }
    at_ += size;
    uint64_t bits = 0;
    for (uint32_t k = size; k-- > 0;) bits = bits << 8 | bytes[k];
    value = decode(type, bits);
    return nullptr;
  }

  // After an element's values: a text may hold no more on that line.
  bool ends_element() {
    std::string_view word;
    return format_ != PlyFormat::kAscii || !scan_.next_word(word);
  }

  // After all elements: whether more follows than white space.
  bool has_more() {
    std::string_view word;
    from_ = at_;
    return is_text() ? scan_.find_word(word)
                     : file_.find_first_not_of(" \t\r\n", at_) != std::string_view::npos;
  }

  bool is_text() const { return format_ == PlyFormat::kAscii; }
  /// Reports what is wrong with the last value. Result: whether reading can go on.
  bool report(ImportSink& sink, const Place& place, const char* wrong) const {
    if (wrong == kEnds) return sink.fail(place, wrong);
    return is_text() ? sink.bad_word(place, word_, wrong) : sink.defect(place, wrong, wrong);
  }
  Place place(const PlyElement& element, uint64_t index) const {
    const char* name = element.name == "vertex" ? "vertex"
                       : element.name == "face" ? "face"
                                                : "element";
    if (is_text()) return {lines_ + scan_.line(), 0, name, index};
    return {0, from_, name, index};
  }

 private:
  static double decode(PlyType type, uint64_t bits) {
    float single = 0;
    double whole = 0;
    const uint32_t low = static_cast<uint32_t>(bits);
    switch (type) {
      case PlyType::kInt8:
        return static_cast<int8_t>(bits);
      case PlyType::kInt16:
        return static_cast<int16_t>(bits);
      case PlyType::kInt32:
        return static_cast<int32_t>(low);
      case PlyType::kFloat32:
        std::memcpy(&single, &low, sizeof single);
        return static_cast<double>(single);
      case PlyType::kFloat64:
        std::memcpy(&whole, &bits, sizeof whole);
        return whole;
      case PlyType::kUint8:
      case PlyType::kUint16:
      case PlyType::kUint32:
        break;
    }
    return low;
  }

  PlyFormat format_;
  std::string_view file_;
  size_t at_, from_;  // where the last value began
  TextScan scan_;
  uint64_t lines_;
  std::string_view word_;
};

struct Wanted {
  int xyz[3] = {-1, -1, -1};
  int corners = -1;
  int material = -1;
};

bool has_corners(const PlyElement& element) {
  return element.name == "face" || element.name == "tristrips";
}

bool is_corner_list(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool is_material(const PlyProperty& property) {
  return !property.is_list && (property.name == "material_index" || property.name == "material");
}

bool find_wanted(const PlyElement& element, Wanted& wanted, ImportSink& sink) {
  const bool is_vertex = element.name == "vertex", is_face = has_corners(element);
  for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
    const PlyProperty& property = element.properties[static_cast<size_t>(i)];
    int* place = nullptr;
    for (int k = 0; is_vertex && k < 3; ++k) {
      if (!property.is_list && property.name.size() == 1 && property.name[0] == 'x' + k)
        place = &wanted.xyz[k];
    }
    if (is_face && is_corner_list(property)) place = &wanted.corners;
    if (is_face && sink.reads_materials() && is_material(property)) place = &wanted.material;
    if (place == nullptr) continue;
    if (*place >= 0) {
      return sink.fail("element " + element.name + " has property " + property.name +
                       " twice: which one counts? Export it again");
    }
    *place = i;
  }
  if (is_vertex && (wanted.xyz[0] < 0 || wanted.xyz[1] < 0 || wanted.xyz[2] < 0)) {
    return sink.fail("element vertex has no properties x, y and z: export it with positions");
  }
  if (!is_face) return true;
  if (wanted.corners < 0)
    return sink.fail("element " + element.name +
                     " has no list vertex_indices: export it with its faces");
  if (!is_integer(element.properties[static_cast<size_t>(wanted.corners)].type)) {
    return sink.fail("vertex_indices are not whole numbers: export the model with integer indices");
  }
  return true;
}

// One list: its items go to `items` where that is given.
bool read_list(PlyValues& values, const PlyProperty& property, const PlyElement& element,
               uint64_t index, std::vector<int64_t>* items, ImportSink& sink) {
  double count = 0, item = 0;
  const char* wrong = values.next(property.count_type, count);
  if (wrong == nullptr && !(count >= 0 && count <= 4294967295.0))
    wrong = "a list with a negative or too large count: export the model again";
  const int64_t most = items == nullptr ? 4294967295 : int64_t{mesh::kMaxTriangles} + 2;
  if (wrong == nullptr && count > static_cast<double>(most))
    wrong = "a face with more corners than an asset has triangles: split it";
  for (int64_t k = 0; wrong == nullptr && k < static_cast<int64_t>(count); ++k) {
    wrong = values.next(property.type, item);
    if (items == nullptr || wrong != nullptr) continue;
    if (!(item >= -2147483648.0 && item <= 4294967295.0)) {
      wrong = "an index that no 32-bit number holds: export the model again";
    } else {
      items->push_back(static_cast<int64_t>(item));
      if (item - static_cast<double>(items->back()) > 0 ||
          item - static_cast<double>(items->back()) < 0)
        wrong = "an index that is not a whole number: export the model again";
    }
  }
  // Where a list ends is not known then: what follows it would be read wrongly.
  return wrong == nullptr || (values.report(sink, values.place(element, index), wrong) &&
                              sink.fail("a list that cannot be read"));
}

// Every three corners in a row are a triangle, every second one turned; -1 begins a new strip.
bool add_strips(const std::vector<int64_t>& corners, const Place& place, ImportSink& sink) {
  std::vector<int64_t> triangle(3);
  size_t first = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] == -1) {
      first = i + 1;
    } else if (i >= first + 2) {
      const bool is_turned = (i - first) % 2 == 1;
      triangle = {corners[i - 2], corners[i - (is_turned ? 0 : 1)],
                  corners[i - (is_turned ? 1 : 0)]};
      if (!sink.add_polygon(triangle, place)) return false;
    }
  }
  return true;
}

bool is_material_number(double value) {
  return value >= 0 && value <= 255 && !(std::floor(value) < value);
}

bool read_element(PlyValues& values, const PlyElement& element, const Wanted& wanted,
                  uint64_t index, std::vector<int64_t>& corners, ImportSink& sink) {
  double xyz[3] = {};
  corners.clear();
  const bool is_face = has_corners(element), is_vertex = element.name == "vertex";
  for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
    const PlyProperty& property = element.properties[static_cast<size_t>(i)];
    if (property.is_list) {
      std::vector<int64_t>* items = is_face && i == wanted.corners ? &corners : nullptr;
      if (!read_list(values, property, element, index, items, sink)) return false;
      continue;
    }
    double value = 0;
    const char* wrong = values.next(property.type, value);
    const bool is_coordinate =
        is_vertex && (i == wanted.xyz[0] || i == wanted.xyz[1] || i == wanted.xyz[2]);
    if (wrong == nullptr && is_coordinate && !(value - value <= 0))
      wrong = "a coordinate is not finite: mend the model";
    const bool is_of_material = is_face && i == wanted.material;
    if (wrong == nullptr && is_of_material && !is_material_number(value))
      wrong = "a material that is not a whole number from 0 (none) to 255: mend the model";
    // Colours and normals are passed over, whatever stands there.
    if (wrong == kEnds || (wrong != nullptr && (is_coordinate || is_of_material))) {
      if (!values.report(sink, values.place(element, index), wrong)) return false;
      value = 0;
    }
    for (int k = 0; k < 3; ++k) {
      if (is_vertex && i == wanted.xyz[k]) xyz[k] = value;
    }
    if (is_of_material) sink.use_material(static_cast<uint32_t>(value));
  }
  const Place place = values.place(element, index);
  if (!element.properties.empty() && !values.ends_element()) {
    return sink.fail(place, "more values on the line than the header states: mend the header");
  }
  if (is_vertex) return sink.add_vertex(xyz, place);
  if (element.name == "tristrips") return add_strips(corners, place, sink);
  return !is_face || sink.add_polygon(corners, place);
}

}  // namespace

void read_ply(std::string_view file, ImportSink& sink) {
  PlyHeader header;
  if (!read_ply_header(file, header, sink)) return;
  PlyValues values(file, header);
  std::vector<int64_t> corners;
  bool has_faces = false, has_vertices = false;
  for (const PlyElement& element : header.elements) {
    Wanted wanted;
    if (!find_wanted(element, wanted, sink)) return;
    bool& is_seen = has_corners(element) ? has_faces : has_vertices;
    if (has_corners(element) || element.name == "vertex") {
      if (is_seen) {
        sink.fail("has element " + element.name + " twice: export it as one mesh");
        return;
      }
      is_seen = true;
    }
    if (element.properties.empty()) continue;  // nothing is stored for it
    for (uint64_t i = 0; i < element.count; ++i) {
      if (!read_element(values, element, wanted, i, corners, sink)) return;
    }
  }
  if (!header.elements.empty() && values.has_more()) {
    const PlyElement& last = header.elements.back();
    sink.fail(values.place(last, last.count),
              "the file goes on after what its header counts: mend the header, or export it again");
    return;
  }
  if (!has_faces && !sink.allows_points())
    sink.fail("has no element face: export it as a triangle mesh; points are taken with --wrap D");
}

}  // namespace firmtouch::tools
