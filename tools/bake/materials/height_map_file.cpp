#include "bake/materials/height_map_file.hpp"

#include <fstream>
#include <limits>

#include "device/refused.hpp"
#include "firmtouch/scene/materials_layout.hpp"

namespace firmtouch::tools {
namespace {

// A number of the head or of a P2 picture. Comments go from # to the line's end.
uint32_t next_number(std::istream& in, const std::string& path) {
  while ((in >> std::ws).peek() == '#')
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  uint32_t number = 0;
  if (!(in >> number))
    throw Refused(path + ": a number of the picture is missing or none; write it again as PGM");
  return number;
}

}  // namespace

HeightMap read_height_map(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Refused(path + ": cannot be opened");
  std::string kind(2, '\0');
  in.read(kind.data(), 2);
  if (!in || (kind != "P5" && kind != "P2"))
    throw Refused(path + ": is no PGM picture (P2 or P5); save it as one, in grey");
  const uint32_t width = next_number(in, path), height = next_number(in, path);
  const uint32_t white = next_number(in, path);
  if (width != height || width < scene::kMinReliefSide || width > scene::kMaxReliefSide ||
      (width & (width - 1)) != 0)
    throw Refused(path + ": is " + std::to_string(width) + " by " + std::to_string(height) +
                  "; scale it to a square with a side of 4, 8, 16, 32 or 64");
  if (white != 255)
    throw Refused(path + ": its white is " + std::to_string(white) + "; save it with 8 bits, 255");
  in.get();
  HeightMap map;
  map.side = width;
  for (uint32_t i = 0; i < width * height; ++i) {
    const uint32_t grey = kind == "P2" ? next_number(in, path) : static_cast<uint32_t>(in.get());
    if (!in || grey > 255)
      throw Refused(path + ": sample " + std::to_string(i) + " of " +
                    std::to_string(width * height) + " is missing or above 255");
    map.samples.push_back(static_cast<uint8_t>(255 - grey));
  }
  return map;
}

}  // namespace firmtouch::tools
