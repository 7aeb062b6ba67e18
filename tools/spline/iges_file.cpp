#include "spline/iges_file.hpp"

#include <array>

#include "surface/read/text_scan.hpp"

namespace firmtouch::tools {
namespace {

constexpr size_t kColumns = 80, kLetter = 72, kSequenceColumns = 7;
constexpr char kSections[] = "SGDPT";

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// Splits off the first line of `rest`, without its end.
std::string_view take_line(std::string_view& rest) {
  const size_t end = rest.find_first_of("\r\n");
  const std::string_view line = rest.substr(0, end);
  const bool is_pair = end != rest.npos && rest.substr(end, 2) == "\r\n";
  rest.remove_prefix(end == rest.npos ? rest.size() : end + (is_pair ? 2 : 1));
  return line;
}

class Splitter {
 public:
  Splitter(std::string_view bytes, SplineSink& sink, IgesFile& file)
      : rest_(bytes),
        sink_(sink),
        sections_{&file.start, &file.global, &file.directory, &file.parameter, &last_} {}

  bool split() {
    while (!rest_.empty()) {
      const std::string_view line = take_line(rest_);
      ++number_;
      if (without_blanks(line).empty() &&
          without_blanks(rest_).find_first_not_of("\r\n ") == rest_.npos)
        break;  // blank lines at the end
      if (!take(line)) return false;
    }
    if (last_.empty())
      return sink_.fail(number_,
                        "the file ends without its last line (section T): it is cut "
                        "short, export it again");
    return counts_match();
  }

 private:
  bool fail(const std::string& what) { return sink_.fail(number_, what); }

  bool take(std::string_view line) {
    if (number_ == 1 && line.size() >= kLetter + 1 &&
        (line[kLetter] == 'C' || line[kLetter] == 'B'))
      return fail("the file is compressed or binary IGES: export it as plain ASCII IGES");
    if (line.size() != kColumns)
      return fail("the line has " + std::to_string(line.size()) +
                  " columns, but every line of an IGES file has 80: an editor or a transfer "
                  "changed it, or it is no IGES file; export it again");
    const size_t section = std::string_view(kSections).find(line[kLetter]);
    if (section == std::string_view::npos)
      return fail("column 73 holds `" + std::string(1, line[kLetter]) +
                  "` where a section letter (S, G, D, P or T) should stand: export it again");
    if (section < section_)
      return fail(std::string("a line of section ") + kSections[section] + " after section " +
                  kSections[section_] + ": lines are in the wrong order, export it again");
    section_ = section;
    int64_t sequence = 0;
    const std::string_view word = without_blanks(line.substr(kLetter + 1, kSequenceColumns));
    const int64_t expected = static_cast<int64_t>(sections_[section]->size()) + 1;
    if (read_integer(word, sequence) != nullptr || sequence != expected)
      return fail("the line says that it is " + std::string(1, kSections[section]) + " `" +
                  std::string(word) + "`, but " + std::to_string(expected) +
                  " follows here: lines are missing or moved, export it again");
    sections_[section]->push_back({line.substr(0, kLetter), number_});
    return true;
  }

  // S, G, D and P of the last line, a letter and seven digits each.
  bool counts_match() {
    for (size_t k = 0; k < 4; ++k) {
      const std::string_view field = last_[0].text.substr(8 * k, 8);
      int64_t count = -1;
      const auto found = static_cast<int64_t>(sections_[k]->size());
      if (field[0] != kSections[k] ||
          read_integer(without_blanks(field.substr(1)), count) != nullptr || count != found)
        return sink_.fail(last_[0].number, std::string("the last line states `") +
                                               std::string(field) + "` where section " +
                                               kSections[k] + " has " + std::to_string(found) +
                                               " lines: lines are missing, export it again");
    }
    return true;
  }

  std::string_view rest_;
  SplineSink& sink_;
  std::vector<IgesFile::Line> last_;
  std::array<std::vector<IgesFile::Line>*, 5> sections_;
  size_t section_ = 0;
  uint64_t number_ = 0;
};

IgesRecord record_of(const IgesFile::Line* first, size_t count, size_t columns) {
  std::string text;
  std::vector<uint64_t> lines;
  for (size_t i = 0; i < count; ++i) {
    text += first[i].text.substr(0, columns);
    lines.push_back(first[i].number);
  }
  return {std::move(text), columns, std::move(lines)};
}

// Metres of the unit flags of the global section; 3 is a unit by name.
constexpr double kUnits_m[] = {0, 0.0254, 0.001,   0,    0.3048, 1609.344,
                               1, 1000,   2.54e-5, 1e-6, 0.01,   2.54e-8};

double named_unit_m(const std::string& name) {
  const struct {
    const char* name;
    int64_t flag;
  } kNames[] = {{"IN", 1}, {"INCH", 1}, {"MM", 2}, {"FT", 4},  {"MI", 5},  {"M", 6},
                {"KM", 7}, {"MIL", 8},  {"UM", 9}, {"CM", 10}, {"UIN", 11}};
  for (const auto& known : kNames)
    if (name == known.name) return kUnits_m[known.flag];
  return 0;
}

}  // namespace

bool split_iges(std::string_view bytes, SplineSink& sink, IgesFile& file) {
  return Splitter(bytes, sink, file).split();
}

bool read_iges_global(SplineSink& sink, double unit_m, IgesFile& file) {
  if (file.global.empty())
    return sink.fail("has no global section (G): export it again as IGES 5.3");
  IgesRecord record = record_of(file.global.data(), file.global.size(), kLetter);
  if (!record.read_delimiters())
    return sink.fail(file.global[0].number,
                     "the global section does not begin with its delimiters (1H,,1H;,): export it "
                     "again");
  file.delimiters = record.delimiters();
  double scale = 1;
  int64_t flag = 1;  // inches, where the file leaves it out
  std::string name, passed;
  const char* wrong = nullptr;
  for (int field = 3; field <= 15 && wrong == nullptr; ++field) {
    if (field == 13) {
      wrong = record.number(scale);
    } else if (field == 14) {
      wrong = record.integer(flag);
    } else {
      wrong = record.string(field == 15 ? name : passed);
    }
    if (wrong != nullptr)
      return sink.fail(record.line(), "global field " + std::to_string(field) + ", `" +
                                          std::string(record.field().substr(0, 40)) + "`, " +
                                          wrong + "; export it again");
  }
  if (unit_m > 0) {
    file.unit_m = unit_m;
    return true;
  }
  if (!(scale > 0))
    return sink.fail(record.line(),
                     "the global section's scale (field 13) is not greater than 0: "
                     "mend it, or give --unit");
  const double own_m = flag == 3 ? named_unit_m(name) : flag > 0 && flag <= 11 ? kUnits_m[flag] : 0;
  if (!(own_m > 0))
    return sink.fail(record.line(),
                     "the global section's unit (fields 14 and 15: " + std::to_string(flag) +
                         ", `" + name + "`) is not known: mend it, or give --unit");
  file.unit_m = own_m / scale;
  return true;
}

bool read_iges_directory(SplineSink& sink, IgesFile& file) {
  if (file.directory.size() % 2 != 0)
    return sink.fail(file.directory.back().number,
                     "the directory (section D) has an odd number of lines, but two belong to "
                     "each entity: export it again");
  for (size_t i = 0; i < file.directory.size(); i += 2) {
    IgesEntry entry;
    entry.line = file.directory[i].number;
    const char subordinate = file.directory[i].text[8 * 8 + 3];  // of the status, field 9
    entry.is_dependent = subordinate == '1' || subordinate == '3';
    int64_t type_again = 0;
    const struct {
      size_t line, field;
      int64_t* into;
    } kFields[] = {{0, 0, &entry.type},
                   {0, 1, &entry.parameters},
                   {0, 6, &entry.matrix},
                   {1, 0, &type_again},
                   {1, 3, &entry.parameter_lines}};
    for (const auto& f : kFields) {
      const IgesFile::Line& line = file.directory[i + f.line];
      const std::string_view word = without_blanks(line.text.substr(8 * f.field, 8));
      if (!word.empty() && read_integer(word, *f.into) != nullptr)
        return sink.fail(line.number, "directory field " + std::to_string(f.field + 1) + ", `" +
                                          std::string(word) +
                                          "`, is not a whole number: export it again");
    }
    if (entry.type != type_again)
      return sink.fail(file.directory[i + 1].number,
                       "the second line of entity " + std::to_string(entry.type) +
                           " says that it is entity " + std::to_string(type_again) +
                           ": lines are missing or moved, export it again");
    file.entries.push_back(entry);
  }
  return true;
}

const IgesEntry* iges_entry(const IgesFile& file, int64_t sequence) {
  if (sequence < 1 || sequence % 2 == 0) return nullptr;
  const auto index = static_cast<size_t>(sequence / 2);
  return index < file.entries.size() ? &file.entries[index] : nullptr;
}

std::string name_of(const IgesEntry& entry) {
  return "entity " + std::to_string(entry.type) + " in line " + std::to_string(entry.line);
}

IgesRecord parameters_of(const IgesFile& file, const IgesEntry& entry, SplineSink& sink,
                         bool& is_whole) {
  constexpr size_t kData = 64;
  const auto lines = static_cast<int64_t>(file.parameter.size());
  is_whole = false;
  if (entry.parameters < 1 || entry.parameter_lines < 1 || entry.parameters > lines ||
      entry.parameter_lines > lines - entry.parameters + 1) {
    sink.defect(entry.line, "pointer",
                name_of(entry) + " points to parameter lines " + std::to_string(entry.parameters) +
                    " and on, " + std::to_string(entry.parameter_lines) +
                    " of them, but there are " + std::to_string(lines) +
                    ": lines are missing, export it again");
    return {"", kData, {}};
  }
  const auto first = static_cast<size_t>(entry.parameters - 1);
  const auto count = static_cast<size_t>(entry.parameter_lines);
  const int64_t own = 2 * (&entry - file.entries.data()) + 1;
  for (size_t i = first; i < first + count; ++i) {
    int64_t of = 0;
    const std::string_view word = without_blanks(file.parameter[i].text.substr(kData));
    if (read_integer(word, of) == nullptr && of == own) continue;
    sink.defect(file.parameter[i].number, "owner",
                "the line says that it belongs to D `" + std::string(word) + "`, but " +
                    name_of(entry) + " (D " + std::to_string(own) +
                    ") points to it: lines are missing or moved, export it again");
    return {"", kData, {}};
  }
  IgesRecord record = record_of(&file.parameter[first], count, kData);
  record.set_delimiters(file.delimiters);
  int64_t type = 0;
  const char* wrong = record.needed_integer(type);
  if (wrong != nullptr || type != entry.type) {
    sink.defect(record.line(), "type",
                name_of(entry) + ": its parameters begin with `" +
                    std::string(record.field().substr(0, 40)) + "`, not with " +
                    std::to_string(entry.type) + ": export it again");
    return record;
  }
  is_whole = true;
  return record;
}

}  // namespace firmtouch::tools
