#include "curve/read_curve_csv.hpp"

#include <array>

#include "curve/csv_rows.hpp"
#include "surface/point.hpp"
#include "surface/read/load_file.hpp"

namespace firmtouch::tools {
namespace {

constexpr char kHeaderWanted[] = "the first line must name the columns: x,y,z";

class Reader {
 public:
  Reader(std::string_view text, const std::string& name, const FileFrame& frame,
         const CsvOptions& options)
      : rows_(text, options.has_decimal_commas),
        has_decimal_commas_(options.has_decimal_commas),
        name_(name),
        frame_(frame) {}

  CurvePoints read() {
    bool has_header = false;
    while (points_.problem.empty() && rows_.next(fields_)) {
      if (!has_header) {
        has_header = true;
        if (take_header()) continue;
      }
      if (points_.problem.empty()) take_row();
    }
    if (!rows_.problem().empty()) {
      points_.problem = name_ + ": " + rows_.problem();
    } else if (!has_header) {
      points_.problem = name_ + ": is empty: " + kHeaderWanted;
    }
    mend_curve(points_, name_);
    return std::move(points_);
  }

 private:
  void fail(const std::string& what) {
    points_.problem = name_ + ": line " + std::to_string(rows_.line()) + ": " + what;
  }

  // Finds x, y and z among the names. Result: how many of them stand there once.
  uint32_t find_columns(const std::vector<std::string_view>& names, std::string& passed_over) {
    std::array<size_t, 3> found{};
    std::array<double, 3> unit_m{};
    columns_ = names.size();
    for (size_t i = 0; i < names.size(); ++i) {
      double of_column_m = 0;
      const std::string name = column_name(names[i], of_column_m);
      const size_t axis = name.size() == 1 ? std::string_view("xyz").find(name) : 3;
      if (axis < 3) {
        column_[axis] = i;
        unit_m[axis] = of_column_m;
        ++found[axis];
      } else {
        passed_over += (passed_over.empty() ? "'" : ", '") + std::string(names[i]) + "'";
      }
    }
    uint32_t once = 0;
    for (size_t axis = 0; axis < 3; ++axis) once += found[axis] == 1 ? 1u : 0u;
    if (once == 3) header_unit_m_ = unit_m;
    return once;
  }

  // Result: whether the row was the header; else it is a sample.
  bool take_header() {
    std::string passed_over, none;
    double value = 0;
    if (find_columns(fields_, passed_over) == 3) {
      if (!passed_over.empty()) points_.notes.push_back("passed over columns " + passed_over);
      take_unit();
      return true;
    }
    if (rows_.number(fields_[0], value) == nullptr) {
      const size_t columns = fields_.size();
      if (find_columns(rows_.comment(), none) == 3 && columns_ == columns) {
        points_.notes.push_back("took the names of the columns from the comment before them");
        take_unit();
        return false;
      }
      columns_ = columns;
      column_ = {0, 1, 2};
      if (columns == 3) {
        points_.notes.push_back("found no header: took the columns as x, y and z");
      } else {
        fail("there is no header and " + std::to_string(columns) + " columns: " + kHeaderWanted);
      }
      return false;
    }
    fail("the header '" + std::string(rows_.text().substr(0, 60)) +
         "' does not name x, y and z once each: " + kHeaderWanted);
    return true;
  }

  void take_unit() {
    if (!(header_unit_m_[0] > 0)) return;
    for (const double unit_m : header_unit_m_) {
      if (unit_m < header_unit_m_[0] || unit_m > header_unit_m_[0])
        return fail("the header gives x, y and z different units: write them in one");
    }
    const FileFrame named(header_unit_m_[0]);
    frame_.take_unit(named.unit_m, named.unit);
  }

  void take_row() {
    if (fields_.size() != columns_) {
      const bool has_semicolons = rows_.text().find(';') != std::string_view::npos;
      const bool has_commas = fields_.size() == 2 * columns_;
      return fail(std::to_string(fields_.size()) + " fields, but the header names " +
                  std::to_string(columns_) +
                  (has_semicolons ? ": it has semicolons where the first line has others"
                   : has_commas   ? ": write decimals with a point, not a comma"
                                  : ": mend or delete this row"));
    }
    double xyz[3] = {};
    for (size_t k = 0; k < 3; ++k) {
      const std::string_view field = fields_[column_[k]];
      const char* wrong = rows_.number(field, xyz[k]);
      if (wrong != nullptr) return fail_number(k, field, wrong);
    }
    const math::Vec3 p = to_vec3(frame_.to_m({xyz[0], xyz[1], xyz[2]}));
    const float placed[3] = {p.x, p.y, p.z};
    for (size_t k = 0; k < 3; ++k)
      if (!(placed[k] - placed[k] <= 0))
        return fail_number(k, fields_[column_[k]], "is too large for a coordinate");
    points_.samples_m.push_back(p);
    points_.rows.push_back(next_row_++);
    points_.lines.push_back(static_cast<uint32_t>(rows_.line()));
  }

  void fail_number(size_t axis, std::string_view field, const char* wrong) {
    const bool has_comma = !has_decimal_commas_ && field.find(',') != field.npos;
    fail(std::string(1, "xyz"[axis]) + " = '" + std::string(field.substr(0, 40)) + "' " + wrong +
         (has_comma ? ", or say --decimal-comma" : ": mend or delete this row"));
  }

  CsvRows rows_;
  bool has_decimal_commas_;
  const std::string& name_;
  FileFrame frame_;
  CurvePoints points_;
  std::vector<std::string_view> fields_;
  std::array<size_t, 3> column_{};
  std::array<double, 3> header_unit_m_{};
  size_t columns_ = 0;
  uint32_t next_row_ = 0;
};

}  // namespace

CurvePoints read_curve_csv_bytes(std::string_view text, const std::string& name,
                                 const FileFrame& frame, const CsvOptions& options) {
  return Reader(text, name, frame, options).read();
}

CurvePoints read_curve_csv(const std::string& path, const FileFrame& frame,
                           const CsvOptions& options) {
  CurvePoints failed;
  const LoadedFile file = load_file(path, kMaxLineBytes);
  if (!file.problem.empty()) {
    failed.problem = path + ": " + file.problem;
    return failed;
  }
  const std::string_view text(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
  return read_curve_csv_bytes(text, path, frame, options);
}

}  // namespace firmtouch::tools
