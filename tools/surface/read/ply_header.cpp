#include "surface/read/ply_header.hpp"

#include "surface/read/text_scan.hpp"

namespace firmtouch::tools {
namespace {

bool type_of(std::string_view word, PlyType& type) {
  static constexpr struct {
    std::string_view name;
    PlyType type;
  } kNames[] = {
      {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
      {"float64", PlyType::kFloat64}};
  for (const auto& known : kNames) {
    if (word == known.name) return type = known.type, true;
  }
  return false;
}

bool read_format(std::string_view word, PlyFormat& format) {
  if (word == "ascii") return format = PlyFormat::kAscii, true;
  if (word == "binary_little_endian") return format = PlyFormat::kLittleEndian, true;
  if (word == "binary_big_endian") return format = PlyFormat::kBigEndian, true;
  return false;
}

// `property TYPE NAME` or `property list COUNT_TYPE TYPE NAME`.
bool read_property(TextScan& line, PlyHeader& header, ImportSink& sink) {
  PlyProperty property;
  std::string_view word;
  const Place place{line.line()};
  if (header.elements.empty()) return sink.fail(place, "a property before any element");
  if (!line.next_word(word)) return sink.fail(place, "a property without a type");
  if (word == "list") {
    property.is_list = true;
    if (!line.next_word(word) || !type_of(word, property.count_type) ||
        !is_integer(property.count_type)) {
      return sink.fail(place, quoted(word) + " cannot count a list");
    }
    if (!line.next_word(word)) return sink.fail(place, "a list without a type");
  }
  if (!type_of(word, property.type)) return sink.fail(place, quoted(word) + " is no type of PLY");
  if (!line.next_word(word)) return sink.fail(place, "a property without a name");
  property.name = std::string(word);
  header.elements.back().properties.push_back(property);
  return true;
}

bool read_element(TextScan& line, PlyHeader& header, ImportSink& sink) {
  std::string_view name, word;
  int64_t count = 0;
  const Place place{line.line()};
  if (!line.next_word(name) || !line.next_word(word))
    return sink.fail(place, "an element needs a name and a count");
  if (read_integer(word, count) != nullptr || count < 0)
    return sink.fail(place, quoted(word) + " is no count");
  header.elements.push_back({std::string(name), static_cast<uint64_t>(count), {}});
  return true;
}

// One line of the header. Result: false with a problem, or at the end.
bool read_line(TextScan& line, std::string_view word, PlyHeader& header, bool& has_format,
               ImportSink& sink) {
  if (word == "comment" || word == "obj_info") return true;
  if (word == "element") return read_element(line, header, sink);
  if (word == "property") return read_property(line, header, sink);
  if (word == "format") {
    std::string_view name;
    has_format = line.next_word(name) && read_format(name, header.format);
    return has_format ||
           sink.fail({line.line()}, quoted(name) + " is no format of PLY: want ascii, " +
                                        "binary_little_endian or binary_big_endian");
  }
  if (word == "end_header") return false;
  return sink.fail({line.line()},
                   quoted(word) + " is no keyword of a PLY header: is the file damaged?");
}

}  // namespace

bool read_ply_header(std::string_view file, PlyHeader& header, ImportSink& sink) {
  TextScan scan(file);
  std::string_view word;
  if (!scan.next_line() || !scan.next_word(word) || word != "ply") {
    const char* other = known_by_content(file);
    return sink.fail(other != nullptr ? std::string("is ") + other +
                                            " by its content, not PLY: rename or export it"
                                      : "does not begin with the line `ply`: is this a PLY file?");
  }
  bool has_format = false;
  while (scan.next_line()) {
    if (!scan.next_word(word)) continue;
    if (read_line(scan, word, header, has_format, sink)) continue;
    if (sink.failed()) return false;
    if (!has_format) return sink.fail({scan.line()}, "the header has no line `format`");
    header.lines = scan.line();
    header.bytes = static_cast<size_t>(scan.at() - file.data());
    if (header.bytes < file.size() && file[header.bytes] == '\r') ++header.bytes;
    if (header.bytes < file.size() && file[header.bytes] == '\n') ++header.bytes;
    return true;
  }
  return sink.fail({scan.line()},
                   "the file ends inside its header (no `end_header`): it is cut short");
}

}  // namespace firmtouch::tools
