#include <cstdint>

#include "spline/spline_sink.hpp"
#include "surface/text_scan.hpp"

// Newell's patches: how many; sixteen point numbers a patch, from 1, u fastest; how many points; x,
// y and z of each. Commas or blanks stand between numbers.

namespace firmtouch::tools {
namespace {

constexpr int64_t kMostPatches = 1000000, kMostPoints = 16 * kMostPatches;

/// The numbers of a text, each with its line.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : scan_(text) {}
  bool next(std::string_view& word) {
    while (rest_.empty()) {
      if (!scan_.find_word(rest_)) return false;
      line_ = scan_.line();
      pass_commas();
    }
    const size_t end = rest_.find(',');
    word = rest_.substr(0, end);
    rest_.remove_prefix(word.size());
    pass_commas();
    return true;
  }
  uint64_t line() const { return line_ == 0 ? scan_.line() : line_; }

 private:
  void pass_commas() {
    while (!rest_.empty() && rest_.front() == ',') rest_.remove_prefix(1);
  }
  TextScan scan_;
  std::string_view rest_;
  uint64_t line_ = 0;
};

struct Patch {
  int64_t corner[16];
  uint64_t line;
};

class Reader {
 public:
  Reader(std::string_view text, double unit_m, SplineSink& sink)
      : numbers_(text), unit_m_(unit_m), sink_(sink) {}

  void read() {
    int64_t patches = 0, points = 0;
    if (!count("patches", kMostPatches, patches) || !read_patches(patches) ||
        !count("points", kMostPoints, points) || !read_points(points))
      return;
    std::string_view word;
    if (numbers_.next(word)) {
      sink_.fail(numbers_.line(), "`" + std::string(word.substr(0, 40)) +
                                      "` comes after the last point: mend the counts");
      return;
    }
    for (size_t i = 0; i < patches_.size(); ++i) take(i);
  }

 private:
  bool word_of(std::string_view& word, const std::string& wanted) {
    if (numbers_.next(word)) return true;
    return sink_.fail(numbers_.line(),
                      "the file ends before " + wanted + ": it is cut short, export it again");
  }

  bool integer(const std::string& what, int64_t& value) {
    std::string_view word;
    if (!word_of(word, what)) return false;
    const char* wrong = read_integer(word, value);
    return wrong == nullptr ||
           sink_.fail(numbers_.line(), what + ": `" + std::string(word.substr(0, 40)) + "` " +
                                           wrong + ": mend it, or export again");
  }

  bool count(const std::string& of, int64_t most, int64_t& value) {
    if (!integer("the number of " + of, value)) return false;
    return (value >= 1 && value <= most) ||
           sink_.fail(numbers_.line(), "the number of " + of + " is " + std::to_string(value) +
                                           ", but 1 to " + std::to_string(most) +
                                           " can be read: mend it");
  }

  bool read_patches(int64_t patches) {
    for (int64_t i = 0; i < patches; ++i) {
      Patch patch{};
      for (int64_t& corner : patch.corner) {
        if (!integer("patch " + std::to_string(i), corner)) return false;
        if (&corner == patch.corner) patch.line = numbers_.line();
        if (numbers_.line() != patch.line)
          return sink_.fail(patch.line, "patch " + std::to_string(i) +
                                            " has not 16 numbers in its line: mend it");
      }
      patches_.push_back(patch);
    }
    return true;
  }

  bool read_points(int64_t points) {
    for (int64_t i = 0; i < points; ++i) {
      double xyz[3];
      for (double& value : xyz) {
        std::string_view word;
        if (!word_of(word, "point " + std::to_string(i + 1) + " of " + std::to_string(points)))
          return false;
        const char* wrong = read_number(word, value);
        if (wrong != nullptr)
          return sink_.fail(numbers_.line(), "point " + std::to_string(i + 1) + ": `" +
                                                 std::string(word.substr(0, 40)) + "` " + wrong +
                                                 ": mend it, or export again");
      }
      points_.push_back({xyz[0] * unit_m_, xyz[1] * unit_m_, xyz[2] * unit_m_, 1});
    }
    return true;
  }

  void take(size_t index) {
    const Patch& patch = patches_[index];
    SplineSurface s;
    s.degree_u = s.degree_v = 3;
    s.count_u = s.count_v = 4;
    s.knots_u = s.knots_v = {0, 0, 0, 0, 1, 1, 1, 1};
    s.where = "patch " + std::to_string(index) + " in line " + std::to_string(patch.line);
    for (int64_t corner : patch.corner) {
      if (corner < 1 || corner > static_cast<int64_t>(points_.size())) {
        sink_.defect(patch.line, "index",
                     s.where + ": point " + std::to_string(corner) +
                         " does not exist, points are 1 to " + std::to_string(points_.size()) +
                         ": mend it, or export again");
        return;
      }
      s.points.push_back(points_[static_cast<size_t>(corner - 1)]);
    }
    const SplineDefect far = check_coordinates(s.points);
    if (!far.what.empty()) {
      sink_.defect(patch.line, "far", s.where + ": " + far.what);
      return;
    }
    sink_.add(std::move(s), patch.line);
  }

  Numbers numbers_;
  double unit_m_;
  SplineSink& sink_;
  std::vector<Patch> patches_;
  std::vector<ControlPoint> points_;
};

}  // namespace

void read_bpt(std::string_view text, double unit_m, SplineSink& sink) {
  Reader(text, unit_m, sink).read();
}

}  // namespace firmtouch::tools
