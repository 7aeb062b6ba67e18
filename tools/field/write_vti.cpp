#include "field/write_vti.hpp"

#include <cstdio>
#include <limits>

namespace firmtouch::tools {
namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the file says LittleEndian");

template <class T>
void append_bytes(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The file's head and, behind it, the arrays: a 64-bit count of bytes, then the bytes.
class VtiText {
 public:
  template <class T, class Value>
  void add(const char* type, const char* name, uint32_t components, size_t items,
           const Value& value) {
    char line[200];
    std::snprintf(line, sizeof line,
                  "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%u\" "
                  "format=\"appended\" offset=\"%zu\"/>\n",
                  type, name, components, data_.size());
    heads_ += line;
    append_bytes(data_, static_cast<uint64_t>(items * components * sizeof(T)));
    for (size_t i = 0; i < items; ++i)
      for (uint32_t k = 0; k < components; ++k) append_bytes(data_, static_cast<T>(value(i, k)));
  }

  std::string whole(const VoxelGrid& grid) const {
    char extent[80], place[200];
    std::snprintf(extent, sizeof extent, "0 %u 0 %u 0 %u", grid.count[0] - 1, grid.count[1] - 1,
                  grid.count[2] - 1);
    const Point origin = grid.centre_m(0, 0, 0);
    std::snprintf(place, sizeof place, "Origin=\"%.17g %.17g %.17g\" Spacing=\"%.17g %.17g %.17g\"",
                  origin.x, origin.y, origin.z, grid.size_m, grid.size_m, grid.size_m);
    return std::string("<?xml version=\"1.0\"?>\n") +
           "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n"
           "  <ImageData WholeExtent=\"" +
           extent + "\" " + place + ">\n    <Piece Extent=\"" + extent +
           "\">\n      <PointData Scalars=\"distance\">\n" + heads_ +
           "      </PointData>\n    </Piece>\n  </ImageData>\n"
           "  <AppendedData encoding=\"raw\">\n_" +
           data_ + "\n  </AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string heads_, data_;
};

// NaN: not computed.
float distance_m(const Nearest& nearest) {
  return nearest.sign == 0 ? std::numeric_limits<float>::quiet_NaN() : nearest.distance_m;
}

float coordinate(const math::Vec3& v, uint32_t k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

}  // namespace

std::string to_vti(const DistanceField& distance_field, const std::vector<Solid>& solids) {
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  const auto& values = distance_field.values;
  const size_t count = values.size();
  VtiText text;
  text.add<float>("Float32", "distance", 1, count,
                  [&](size_t i, uint32_t) { return distance_m(values[i]); });
  text.add<float>("Float32", "closest_point", 3, count, [&](size_t i, uint32_t k) {
    return values[i].sign == 0 ? nothing : coordinate(values[i].closest_m, k);
  });
  text.add<int32_t>("Int32", "triangle", 1, count, [&](size_t i, uint32_t) {
    const Nearest& n = values[i];
    return n.sign == 0 ? -1 : static_cast<int32_t>(solids[n.object].surface.source[n.face]);
  });
  text.add<int16_t>("Int16", "object", 1, count, [&](size_t i, uint32_t) {
    return values[i].sign == 0 ? -1 : static_cast<int>(values[i].object);
  });
  text.add<int8_t>("Int8", "side", 1, count, [&](size_t i, uint32_t) { return values[i].sign; });
  text.add<uint8_t>("UInt8", "kind", 1, count, [&](size_t i, uint32_t) {
    return static_cast<uint8_t>(distance_field.kinds[i]);
  });
  return text.whole(distance_field.grid);
}

std::string to_nrrd(const DistanceField& distance_field) {
  const VoxelGrid& grid = distance_field.grid;
  const Point origin = grid.centre_m(0, 0, 0);
  char head[400];
  std::snprintf(
      head, sizeof head,
      "NRRD0004\n# signed distance, metres\ntype: float\ndimension: 3\nspace dimension: 3\n"
      "sizes: %u %u %u\nspace directions: (%.17g,0,0) (0,%.17g,0) (0,0,%.17g)\n"
      "space origin: (%.17g,%.17g,%.17g)\nspace units: \"m\" \"m\" \"m\"\n"
      "kinds: domain domain domain\nendian: little\nencoding: raw\n\n",
      grid.count[0], grid.count[1], grid.count[2], grid.size_m, grid.size_m, grid.size_m, origin.x,
      origin.y, origin.z);
  std::string text = head;
  for (const Nearest& nearest : distance_field.values) append_bytes(text, distance_m(nearest));
  return text;
}

}  // namespace firmtouch::tools
