#include "spline/write_iges.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace firmtouch::tools {
namespace {

// The least digits that read back to the bit; a decimal point makes it a real number.
std::string real(double value) {
  char text[40];
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(text, sizeof(text), "%.*E", digits - 1, value);
    const double back = std::strtod(text, nullptr);
    if (!(back < value || back > value)) break;
  }
  return text;
}

// The fields of one record, broken into lines between fields.
class Fields {
 public:
  explicit Fields(size_t columns) : columns_(columns) {}

  void put(const std::string& field) {
    if (lines_.back().size() + field.size() + 1 > columns_) lines_.emplace_back();
    lines_.back() += field + ",";
  }
  void integers(std::initializer_list<size_t> values) {
    for (const size_t value : values) put(std::to_string(value));
  }
  void reals(const std::vector<double>& values) {
    for (const double value : values) put(real(value));
  }
  void weights_and_places(const std::vector<ControlPoint>& points) {
    for (const ControlPoint& p : points) put(real(p.w));
    for (const ControlPoint& p : points) reals({p.x, p.y, p.z});
  }
  std::vector<std::string> ended() {
    lines_.back().back() = ';';
    return lines_;
  }

 private:
  size_t columns_;
  std::vector<std::string> lines_{""};
};

std::vector<std::string> global_section() {
  Fields fields(72);
  for (const char* field : {"1H,", "1H;", "6Hspline", "10Hspline.igs", "9Hfirmtouch", "1H1"})
    fields.put(field);
  fields.integers({32, 38, 6, 308, 15});
  for (const char* field : {"6Hspline", "1.", "6", "1HM"}) fields.put(field);
  return fields.ended();
}

std::vector<std::string> parameters_of(const SplineCurve& c) {
  Fields fields(64);
  fields.integers({126, c.points.size() - 1, static_cast<size_t>(c.degree), size_t{c.is_planar}, 0,
                   size_t{!is_rational(c.points)}, 0});
  fields.reals(c.knots);
  fields.weights_and_places(c.points);
  fields.reals({c.t0, c.t1, 0, 0, 1});
  return fields.ended();
}

std::vector<std::string> parameters_of(const SplineSurface& s) {
  Fields fields(64);
  fields.integers({128, s.count_u - 1, s.count_v - 1, static_cast<size_t>(s.degree_u),
                   static_cast<size_t>(s.degree_v), 0, 0, size_t{!is_rational(s.points)}, 0, 0});
  fields.reals(s.knots_u);
  fields.reals(s.knots_v);
  fields.weights_and_places(s.points);
  fields.reals({s.u0, s.u1, s.v0, s.v1});
  return fields.ended();
}

// 80 columns a line: its text, its section and its number there.
class Sheet {
 public:
  void add(char section, const std::string& columns) {
    const size_t k = std::string_view("SGDPT").find(section);
    char line[100];
    std::snprintf(line, sizeof(line), "%-72s%c%7zu\n", columns.c_str(), section, ++counts_[k]);
    text_ += line;
  }
  size_t count_of(char section) const { return counts_[std::string_view("SGDPT").find(section)]; }
  const std::string& text() const { return text_; }

 private:
  size_t counts_[5] = {};
  std::string text_;
};

struct Entity {
  int type;
  std::vector<std::string> parameters;
};

}  // namespace

std::string to_iges(const SplineModel& model) {
  std::vector<Entity> entities;
  for (const SplineCurve& c : model.curves) entities.push_back({126, parameters_of(c)});
  for (const SplineSurface& s : model.surfaces) entities.push_back({128, parameters_of(s)});

  Sheet sheet;
  sheet.add('S', "made by firmtouch");
  for (const std::string& line : global_section()) sheet.add('G', line);
  char text[100];
  size_t first = 1;
  for (const Entity& entity : entities) {
    std::snprintf(text, sizeof(text), "%8d%8zu%8d%8d%8d%8d%8d%8d%08d", entity.type, first, 0, 0, 0,
                  0, 0, 0, 0);
    sheet.add('D', text);
    std::snprintf(text, sizeof(text), "%8d%8d%8d%8zu%8d", entity.type, 0, 0,
                  entity.parameters.size(), 0);
    sheet.add('D', text);
    first += entity.parameters.size();
  }
  for (size_t e = 0; e < entities.size(); ++e)
    for (const std::string& line : entities[e].parameters) {
      std::snprintf(text, sizeof(text), "%-64s%8zu", line.c_str(), 2 * e + 1);
      sheet.add('P', text);
    }
  std::snprintf(text, sizeof(text), "S%7zuG%7zuD%7zuP%7zu", sheet.count_of('S'),
                sheet.count_of('G'), sheet.count_of('D'), sheet.count_of('P'));
  sheet.add('T', text);
  return sheet.text();
}

}  // namespace firmtouch::tools
