#include <cstdint>

#include "spline/spline_sink.hpp"
#include "surface/read/text_scan.hpp"

// Patches, how many first. Newell's: sixteen point numbers a patch, from 1, u fastest, in a line;
// how many points; x, y and z of each. Or each patch by itself: its two degrees, then its points, u
// fastest. Commas or blanks stand between numbers.

namespace firmtouch::tools {
namespace {

constexpr char kComma[] =
    "; commas separate numbers here: were decimal commas used? Write 0.1, not `0,1`";
constexpr int64_t kMaxPatches = 1000000, kMaxPoints = 16 * kMaxPatches;

/// The numbers of a text, each with its line.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : scan_(text) {}
  bool next(std::string_view& word) {
    while (rest_.empty()) {
      if (!scan_.find_word(rest_)) return false;
      if (line_ != scan_.line()) in_line_ = 0;
      line_ = scan_.line();
      see_commas();
      pass_commas();
    }
    const size_t end = rest_.find(',');
    word = rest_.substr(0, end);
    rest_.remove_prefix(word.size());
    pass_commas();
    return true;
  }
  /// Whether the line of the number read last goes on.
  bool more_in_line() {
    if (rest_.empty() && scan_.next_word(rest_)) {
      see_commas();
      pass_commas();
    }
    return !rest_.empty();
  }
  /// Whether a line had several words that a comma divides, as `0,1 0,2`: decimals, perhaps.
  bool has_decimal_commas() const { return has_decimal_commas_; }
  uint64_t line() const { return line_ == 0 ? scan_.line() : line_; }

 private:
  void see_commas() {
    const size_t comma = rest_.find(',');
    const bool is_divided = comma != rest_.npos && comma > 0 && comma + 1 < rest_.size();
    in_line_ += is_divided ? 1 : 0;
    has_decimal_commas_ = has_decimal_commas_ || in_line_ > 1;
  }
  void pass_commas() {
    while (!rest_.empty() && rest_.front() == ',') rest_.remove_prefix(1);
  }
  TextScan scan_;
  std::string_view rest_;
  uint64_t line_ = 0;
  uint32_t in_line_ = 0;  // words that a comma divides
  bool has_decimal_commas_ = false;
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
    int64_t patches = 0, points = 0, first = 0, second = 0;
    if (!count("patches", kMaxPatches, patches) || !integer("patch 0", first)) return;
    const uint64_t line = numbers_.line();
    if (!integer("patch 0", second)) return;
    is_indexed_ = numbers_.line() != line || numbers_.more_in_line();
    if (is_indexed_ ? !read_patches(patches, line, first, second) ||
                          !count("points", kMaxPoints, points) || !read_points(points)
                    : !read_each(patches, line, first, second))
      return;
    std::string_view word;
    if (numbers_.next(word)) {
      fail(numbers_.line(),
           "`" + std::string(word.substr(0, 40)) + "` comes after the last point: mend the counts");
      return;
    }
    for (size_t i = 0; i < patches_.size(); ++i) take(i);
    for (size_t i = 0; i < whole_.size(); ++i) check_and_add(std::move(whole_[i]), lines_[i]);
  }

 private:
  bool fail(uint64_t line, const std::string& what) {
    return sink_.fail(line, numbers_.has_decimal_commas() ? what + kComma : what);
  }
  bool word_of(std::string_view& word, const std::string& wanted) {
    if (numbers_.next(word)) return true;
    return fail(numbers_.line(),
                "the file ends before " + wanted + ": it is cut short, export it again");
  }

  bool integer(const std::string& what, int64_t& value) {
    std::string_view word;
    if (!word_of(word, what)) return false;
    const char* wrong = read_integer(word, value);
    return wrong == nullptr ||
           fail(numbers_.line(), what + ": `" + std::string(word.substr(0, 40)) + "` " + wrong +
                                     ": mend it, or export again");
  }

  bool count(const std::string& of, int64_t most, int64_t& value) {
    if (!integer("the number of " + of, value)) return false;
    return (value >= 1 && value <= most) ||
           fail(numbers_.line(), "the number of " + of + " is " + std::to_string(value) +
                                     ", but 1 to " + std::to_string(most) +
                                     " can be read: mend it");
  }

  bool read_patches(int64_t patches, uint64_t line, int64_t first, int64_t second) {
    for (int64_t i = 0; i < patches; ++i) {
      Patch patch{};
      for (int64_t& corner : patch.corner) {
        const auto k = &corner - patch.corner;
        if (i == 0 && k < 2)
          corner = k == 0 ? first : second;
        else if (!integer("patch " + std::to_string(i), corner))
          return false;
        if (k == 0) patch.line = i == 0 ? line : numbers_.line();
        if (k > 1 || i > 0 ? numbers_.line() != patch.line : false)
          return fail(patch.line,
                      "patch " + std::to_string(i) + " has not 16 numbers in its line: mend it");
      }
      patches_.push_back(patch);
    }
    return true;
  }

  // Each patch with its own points.
  bool read_each(int64_t patches, uint64_t line, int64_t first, int64_t second) {
    for (int64_t i = 0; i < patches; ++i) {
      const std::string name = "patch " + std::to_string(i);
      if (i > 0) {
        if (!integer(name, first)) return false;
        line = numbers_.line();
        if (!integer(name, second)) return false;
      }
      if (first < 1 || first > kMaxDegree || second < 1 || second > kMaxDegree)
        return fail(line, name + " is of degrees " + std::to_string(first) + " and " +
                              std::to_string(second) +
                              ", but 1 to 5 are read: mend it, or lower them at export");
      const int64_t points = (first + 1) * (second + 1);
      points_.clear();
      if (!read_points(points)) return false;
      whole_.push_back(surface_of(static_cast<int>(first), static_cast<int>(second)));
      whole_.back().points = points_;
      whole_.back().where = name + " in line " + std::to_string(line);
      lines_.push_back(line);
    }
    return true;
  }

  static SplineSurface surface_of(int degree_u, int degree_v) {
    SplineSurface s;
    s.degree_u = degree_u, s.degree_v = degree_v;
    s.count_u = static_cast<size_t>(degree_u) + 1, s.count_v = static_cast<size_t>(degree_v) + 1;
    s.knots_u.assign(s.count_u, 0.0), s.knots_u.resize(2 * s.count_u, 1.0);
    s.knots_v.assign(s.count_v, 0.0), s.knots_v.resize(2 * s.count_v, 1.0);
    return s;
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
          return fail(numbers_.line(), "point " + std::to_string(i + 1) + ": `" +
                                           std::string(word.substr(0, 40)) + "` " + wrong +
                                           ": mend it, or export again");
      }
      points_.push_back({xyz[0] * unit_m_, xyz[1] * unit_m_, xyz[2] * unit_m_, 1});
    }
    return true;
  }

  void take(size_t index) {
    const Patch& patch = patches_[index];
    SplineSurface s = surface_of(3, 3);
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
    check_and_add(std::move(s), patch.line);
  }

  void check_and_add(SplineSurface s, uint64_t line) {
    const SplineDefect far = check_coordinates(s.points);
    if (!far.what.empty())
      sink_.defect(line, "far", s.where + ": " + far.what);
    else
      sink_.add(std::move(s), line);
  }

  Numbers numbers_;
  double unit_m_;
  SplineSink& sink_;
  std::vector<Patch> patches_;
  std::vector<ControlPoint> points_;
  bool is_indexed_ = true;
  std::vector<SplineSurface> whole_;  // patches that hold their own points
  std::vector<uint64_t> lines_;       // theirs
};

}  // namespace

void read_bpt(std::string_view text, double unit_m, SplineSink& sink) {
  Reader(text, unit_m, sink).read();
}

}  // namespace firmtouch::tools
