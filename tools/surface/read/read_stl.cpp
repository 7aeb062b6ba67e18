#include <cstring>

#include "surface/read/stl_facets.hpp"

// STL, which has two forms. Binary: 80 bytes of any content, the number of facets, then 50 bytes a
// facet. Text: `solid NAME`, facets, `endsolid NAME`. Many binary files begin with the word
// `solid`, so the length decides: no text can be as long as its bytes 80 to 83, taken as a number
// of facets, would have it (0.5 billion facets at least).

namespace firmtouch::tools {
namespace {

constexpr size_t kHeaderBytes = 84, kFacetBytes = 50;

uint64_t u32_at(std::string_view bytes, size_t at) {
  uint64_t value = 0;
  for (size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

double f32_at(std::string_view bytes, size_t at) {
  const uint32_t bits = static_cast<uint32_t>(u32_at(bytes, at));
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

Point point_at(std::string_view bytes, size_t at) {
  return {f32_at(bytes, at), f32_at(bytes, at + 4), f32_at(bytes, at + 8)};
}

bool has_its_length(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes &&
         bytes.size() == kHeaderBytes + kFacetBytes * u32_at(bytes, 80);
}

// A binary's number of facets has a zero among its bytes up to 16.7 million of them, and its first
// facet has two attribute bytes, as a rule.
bool is_text(std::string_view bytes) {
  if (bytes.substr(0, kHeaderBytes + kFacetBytes).find('\0') != bytes.npos) return false;
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  const size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == bytes.npos || bytes.size() - first < 5) return false;
  constexpr std::string_view kSolid = "solid";
  for (size_t k = 0; k < kSolid.size(); ++k) {
    if ((bytes[first + k] | 0x20) != kSolid[k]) return false;
  }
  return true;
}

void refuse(std::string_view bytes, ImportSink& sink) {
  const std::string_view other = known_by_content(bytes) != nullptr ? known_by_content(bytes) : "";
  if (!other.empty() && other != "an STL file" && other != "a binary file") {
    sink.fail("is " + std::string(other) +
              " by its content, not STL: rename it, or export the model as STL");
    return;
  }
  if (bytes.size() < kHeaderBytes) {
    sink.fail(
        "neither begins with the word `solid` nor is as long as the header of a binary STL "
        "(84 bytes; these are " +
        std::to_string(bytes.size()) + "): is it cut short? Export it again");
    return;
  }
  const uint64_t count = u32_at(bytes, 80), wanted = kHeaderBytes + kFacetBytes * count,
                 whole = (bytes.size() - kHeaderBytes) / kFacetBytes;
  const std::string said = "the header states " + std::to_string(count) + " facets, " +
                           std::to_string(wanted) + " bytes in all, but the file has " +
                           std::to_string(bytes.size()) + ": ";
  if (count > whole) {
    sink.fail({0, 80, nullptr, 0},
              said + "it holds " + std::to_string(whole) +
                  " whole facets; it is cut short, or no STL file; export it again");
  } else {
    sink.fail(
        {0, 80, nullptr, 0},
        said + std::to_string(bytes.size() - wanted) +
            " bytes too many; the number is wrong or something was appended; export it again");
  }
}

}  // namespace

void read_stl_binary(std::string_view bytes, ImportSink& sink) {
  const uint64_t count = u32_at(bytes, 80);
  uint64_t with_attribute = 0;
  StlFacets facets(sink);
  for (uint64_t i = 0; i < count; ++i) {
    const size_t at = kHeaderBytes + kFacetBytes * static_cast<size_t>(i);
    const Point corners[3] = {point_at(bytes, at + 12), point_at(bytes, at + 24),
                              point_at(bytes, at + 36)};
    if (bytes[at + 48] != 0 || bytes[at + 49] != 0) ++with_attribute;
    if (!facets.add(point_at(bytes, at), corners, {0, at, "facet", i})) return;
  }
  if (with_attribute != 0) {
    sink.note("passed over the attribute bytes (colours) of " + std::to_string(with_attribute) +
              " of " + std::to_string(count) + " facets");
  }
  facets.finish();
}

void read_stl(std::string_view bytes, ImportSink& sink) {
  if (has_its_length(bytes)) return read_stl_binary(bytes, sink);
  if (is_text(bytes)) return read_stl_text(bytes, sink);
  refuse(bytes, sink);
}

}  // namespace firmtouch::tools
