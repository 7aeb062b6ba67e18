#include "curve/read_curve_csv.hpp"

#include <array>

#include "surface/read/load_file.hpp"
#include "surface/read/text_scan.hpp"

namespace firmtouch::tools {
namespace {

constexpr char kHeaderWanted[] = "the first line must name the columns: x,y,z";

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return text;
}

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return;
    line.remove_prefix(comma + 1);
  }
}

/// Lines of a text without their ends.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
  }
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const size_t end = rest_.find_first_of("\r\n");
    line = rest_.substr(0, end);
    const bool is_pair = end != rest_.npos && rest_.substr(end, 2) == "\r\n";
    rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + (is_pair ? 2 : 1));
    ++number_;
    return true;
  }
  uint64_t number() const { return number_; }

 private:
  std::string_view rest_;
  uint64_t number_ = 0;
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& name, double unit_m)
      : lines_(text), name_(name), unit_m_(unit_m) {}

  CurvePoints read() {
    std::string_view line;
    bool has_header = false;
    while (points_.problem.empty() && lines_.next(line)) {
      line = trimmed(line);
      if (line.empty()) continue;
      if (has_header) {
        take_row(line);
      } else {
        take_header(line);
        has_header = true;
      }
    }
    if (!has_header) points_.problem = name_ + ": is empty: " + kHeaderWanted;
    mend_curve(points_, name_);
    return std::move(points_);
  }

 private:
  void fail(const std::string& what) {
    points_.problem = name_ + ": line " + std::to_string(lines_.number()) + ": " + what;
  }

  // What separates the fields if not a comma, or nullptr.
  static const char* other_separator(std::string_view line) {
    if (line.find(';') != line.npos) return "semicolons";
    if (line.find(',') != line.npos) return nullptr;
    if (line.find('\t') != line.npos) return "tabs";
    return line.find(' ') != line.npos ? "spaces" : nullptr;
  }

  void fail_separator(const char* separator) {
    fail(std::string("fields are separated by ") + separator +
         ": separate them by commas, and write decimals with a point");
  }

  void take_header(std::string_view line) {
    if (const char* separator = other_separator(line)) return fail_separator(separator);
    split(line, fields_);
    columns_ = fields_.size();
    std::string passed_over;
    std::array<size_t, 3> found{};
    for (size_t i = 0; i < columns_; ++i) {
      const size_t axis = fields_[i].size() == 1 ? std::string_view("xyz").find(fields_[i]) : 3;
      if (axis < 3) {
        column_[axis] = i;
        ++found[axis];
      } else {
        passed_over += (passed_over.empty() ? "'" : ", '") + std::string(fields_[i]) + "'";
      }
    }
    double value = 0;
    if (found == std::array<size_t, 3>{1, 1, 1}) {
      if (!passed_over.empty()) points_.notes.push_back("passed over columns " + passed_over);
    } else if (read_number(fields_[0], value) == nullptr) {
      fail(std::string("there is no header: ") + kHeaderWanted);
    } else {
      fail("the header '" + std::string(line.substr(0, 60)) +
           "' does not name x, y and z once "
           "each: " +
           kHeaderWanted);
    }
  }

  void take_row(std::string_view line) {
    if (const char* separator = other_separator(line)) return fail_separator(separator);
    split(line, fields_);
    if (fields_.size() != columns_)
      return fail(std::to_string(fields_.size()) + " fields, but the header names " +
                  std::to_string(columns_) +
                  (fields_.size() == 2 * columns_ ? ": write decimals with a point, not a comma"
                                                  : ": mend or delete this row"));
    std::array<float, 3> xyz{};
    for (size_t k = 0; k < 3; ++k) {
      const std::string_view field = fields_[column_[k]];
      double value = 0;
      const char* wrong = read_number(field, value);
      xyz[k] = static_cast<float>(value * unit_m_);
      if (wrong == nullptr && !(xyz[k] - xyz[k] <= 0)) wrong = "is too large for a coordinate";
      if (wrong != nullptr)
        return fail(std::string(1, "xyz"[k]) + " = '" + std::string(field.substr(0, 40)) + "' " +
                    wrong + ": mend or delete this row");
    }
    points_.samples_m.push_back({xyz[0], xyz[1], xyz[2]});
    points_.rows.push_back(next_row_++);
  }

  Lines lines_;
  const std::string& name_;
  double unit_m_;
  CurvePoints points_;
  std::vector<std::string_view> fields_;
  std::array<size_t, 3> column_{};
  size_t columns_ = 0;
  uint32_t next_row_ = 0;
};

}  // namespace

CurvePoints read_curve_csv_bytes(std::string_view text, const std::string& name, double unit_m) {
  return Reader(text, name, unit_m).read();
}

CurvePoints read_curve_csv(const std::string& path, double unit_m) {
  CurvePoints failed;
  const LoadedFile file = load_file(path, kMaxLineBytes);
  if (!file.problem.empty()) {
    failed.problem = path + ": " + file.problem;
    return failed;
  }
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  return read_curve_csv_bytes(text, path, unit_m);
}

}  // namespace firmtouch::tools
