#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "spline/iges_file.hpp"

// IGES 5.3: rational B-spline curves (126) and surfaces (128), placed by transformations (124).

namespace firmtouch::tools {
namespace {

constexpr int64_t kMaxIndex = 100000;  // of a control point in one direction

// Entities that say how others look, are named, grouped or shown, and hold no shape of their own.
constexpr int64_t kWithoutShape[] = {0,   124, 302, 304, 310, 312, 314,
                                     316, 322, 402, 404, 406, 410, 422};

// What can be done about shapes that are not read.
const char* remedy_of(int64_t type) {
  switch (type) {
    case 141:
    case 142:
    case 143:
    case 144:
      return "trimmed surfaces are not read: export untrimmed NURBS surfaces (128), or a mesh";
    case 100:
    case 102:
    case 104:
    case 106:
    case 110:
    case 112:
    case 130:
      return "only NURBS curves (126) are read: convert it at export";
    case 108:
    case 114:
    case 118:
    case 120:
    case 122:
    case 140:
      return "only NURBS surfaces (128) are read: convert it at export";
    case 308:
    case 408:
    case 430:
      return "instances are not read: explode them at export";
    default:
      return "only NURBS curves (126) and surfaces (128) are read: convert or remove it";
  }
}

struct Placement {
  std::array<double, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // rows of R, then T

  Point place(double x, double y, double z) const {
    return {m[0] * x + m[1] * y + m[2] * z + m[3], m[4] * x + m[5] * y + m[6] * z + m[7],
            m[8] * x + m[9] * y + m[10] * z + m[11]};
  }
};

class Reader {
 public:
  Reader(const IgesFile& file, SplineSink& sink) : file_(file), sink_(sink) {}

  void read() {
    for (const IgesEntry& entry : file_.entries)
      if (entry.type == 102 || (entry.type == 144 && is_untrimmed(entry))) find_children(entry);
    if (sink_.failed()) return;
    for (const IgesEntry& entry : file_.entries) {
      if (entry.type == 126) {
        curve(entry);
      } else if (entry.type == 128) {
        surface(entry);
      } else if (entry.type == 144 && is_untrimmed(entry)) {
        ++passed_over_;
      } else if (entry.type == 102 ||
                 std::count(std::begin(kWithoutShape), std::end(kWithoutShape), entry.type) != 0) {
        // A composite curve (102) is a list of curves that stand in the file themselves.
        passed_over_ += entry.type != 124;
      } else {
        sink_.defect(entry.line, "type" + std::to_string(entry.type),
                     name_of(entry) + ": " + remedy_of(entry.type));
      }
    }
    if (passed_over_ != 0)
      sink_.note("passed over " + std::to_string(passed_over_) +
                 (passed_over_ == 1 ? " entity that holds" : " entities that hold") +
                 " no shape of their own (groups, colours, names)");
  }

 private:
  // A wrong field: which, and of what entity.
  bool bad_field(const IgesRecord& record, const IgesEntry& entry, const std::string& what,
                 const char* wrong) {
    const std::string word(record.field().substr(0, 40));
    std::string text =
        name_of(entry) + ": " + what + (word.empty() ? "" : ", `" + word + "`,") + " " + wrong;
    if (text.find("export") == text.npos && text.find("point") == text.npos)
      text += "; mend it, or export it again";
    return sink_.defect(record.line(), "field", text);
  }

  bool bad(uint64_t line, const IgesEntry& entry, const SplineDefect& defect) {
    return sink_.defect(line, "spline", name_of(entry) + ": " + defect.what);
  }

  bool integers(IgesRecord& record, const IgesEntry& entry, const char* const* names,
                int64_t* values, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      const char* wrong = record.needed_integer(values[i]);
      if (wrong == nullptr && (values[i] < 0 || values[i] > kMaxIndex))
        wrong = "is not from 0 to 100000";
      if (wrong != nullptr) return bad_field(record, entry, names[i], wrong);
    }
    return true;
  }

  // `count` numbers, each with the line where it stands.
  bool numbers(IgesRecord& record, const IgesEntry& entry, const char* what, size_t count,
               std::vector<double>& values, std::vector<uint64_t>& lines) {
    values.clear();
    lines.clear();
    for (size_t i = 0; i < count; ++i) {
      double value = 0;
      const char* wrong = record.needed_number(value);
      if (wrong != nullptr)
        return bad_field(record, entry, std::string(what) + " " + std::to_string(i) + " (from 0)",
                         wrong);
      values.push_back(value);
      lines.push_back(record.line());
    }
    return true;
  }

  bool knots(IgesRecord& record, const IgesEntry& entry, const char* which, int64_t degree,
             size_t points, std::vector<double>& values) {
    std::vector<uint64_t> lines;
    // A wrong degree or count is reported before so many numbers are searched.
    const SplineDefect shape = check_knots({}, static_cast<int>(degree), points, which);
    const bool is_unfit =
        degree < 1 || degree > kMaxDegree || points <= static_cast<size_t>(degree);
    if (is_unfit) return bad(record.line(), entry, shape);
    if (!numbers(record, entry, which, points + static_cast<size_t>(degree) + 1, values, lines))
      return false;
    const SplineDefect defect = check_knots(values, static_cast<int>(degree), points, which);
    return defect.what.empty() || bad(lines[defect.index], entry, defect);
  }

  // Weights, then coordinates, placed and in metres.
  bool points(IgesRecord& record, const IgesEntry& entry, size_t count,
              std::vector<ControlPoint>& into) {
    std::vector<double> weights, xyz;
    std::vector<uint64_t> lines;
    if (!numbers(record, entry, "weight", count, weights, lines)) return false;
    into.assign(count, {});
    for (size_t i = 0; i < count; ++i) into[i].w = weights[i];
    const SplineDefect light = check_weights(into);
    if (!light.what.empty()) return bad(lines[light.index], entry, light);
    if (!numbers(record, entry, "coordinate", 3 * count, xyz, lines)) return false;
    Placement placement;
    if (!placement_of(entry, placement)) return false;
    for (size_t i = 0; i < count; ++i) {
      const Point p = placement.place(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]) * file_.unit_m;
      into[i].x = p.x, into[i].y = p.y, into[i].z = p.z;
    }
    const SplineDefect far = check_coordinates(into);
    return far.what.empty() || bad(lines[3 * far.index], entry, far);
  }

  // The part that is used, within what the knots allow.
  bool range(IgesRecord& record, const IgesEntry& entry, const char* which, double low, double high,
             double& from, double& to, bool is_last) {
    std::vector<double> ends;
    std::vector<uint64_t> lines;
    if (!numbers(record, entry, which, 2, ends, lines)) return false;
    const double slack = 1e-6 * (high - low);  // files print a few digits
    if (const char* wrong = is_last ? record.finish() : nullptr)
      return bad_field(record, entry, "its last field", wrong);
    from = std::max(ends[0], low), to = std::min(ends[1], high);
    if (ends[0] >= low - slack && ends[1] <= high + slack && from < to) return true;
    char text[160];
    std::snprintf(text, sizeof(text),
                  "it is used from %.9g to %.9g, but its knots reach from %.9g to %.9g: mend the "
                  "range, or export it again",
                  ends[0], ends[1], low, high);
    return bad(lines[0], entry, {text, 0});
  }

  void curve(const IgesEntry& entry) {
    bool is_whole = false;
    IgesRecord record = parameters_of(file_, entry, sink_, is_whole);
    static const char* const kNames[] = {"the last index", "the degree", "flag 1",
                                         "flag 2",         "flag 3",     "flag 4"};
    int64_t head[6] = {};
    if (!is_whole || !integers(record, entry, kNames, head, 6)) return;
    SplineCurve c;
    c.degree = static_cast<int>(head[1]);
    c.where = name_of(entry);
    const auto count = static_cast<size_t>(head[0]) + 1;
    if (!knots(record, entry, "knot", head[1], count, c.knots) ||
        !points(record, entry, count, c.points) ||
        !range(record, entry, "end of the range", c.knots[static_cast<size_t>(head[1])],
               c.knots[count], c.t0, c.t1, true))
      return;
    sink_.add(std::move(c), entry.line);
  }

  void surface(const IgesEntry& entry) {
    bool is_whole = false;
    IgesRecord record = parameters_of(file_, entry, sink_, is_whole);
    static const char* const kNames[] = {"the last index in u",
                                         "the last index in v",
                                         "the degree in u",
                                         "the degree in v",
                                         "flag 1",
                                         "flag 2",
                                         "flag 3",
                                         "flag 4",
                                         "flag 5"};
    int64_t head[9] = {};
    if (!is_whole || !integers(record, entry, kNames, head, 9)) return;
    SplineSurface s;
    s.degree_u = static_cast<int>(head[2]), s.degree_v = static_cast<int>(head[3]);
    s.count_u = static_cast<size_t>(head[0]) + 1, s.count_v = static_cast<size_t>(head[1]) + 1;
    s.where = name_of(entry);
    if (!knots(record, entry, "u knot", head[2], s.count_u, s.knots_u) ||
        !knots(record, entry, "v knot", head[3], s.count_v, s.knots_v) ||
        !points(record, entry, s.count_u * s.count_v, s.points) ||
        !range(record, entry, "end of the range of u", s.knots_u[static_cast<size_t>(head[2])],
               s.knots_u[s.count_u], s.u0, s.u1, false) ||
        !range(record, entry, "end of the range of v", s.knots_v[static_cast<size_t>(head[3])],
               s.knots_v[s.count_v], s.v0, s.v1, true))
      return;
    sink_.add(std::move(s), entry.line);
  }

  // 144 with the surface's own boundary and no hole: the surface itself, which stands in the file.
  bool is_untrimmed(const IgesEntry& entry) {
    bool is_whole = false;
    IgesRecord record = parameters_of(file_, entry, sink_, is_whole);
    int64_t surface = 0, outer = 1, holes = 1;
    return is_whole && record.needed_integer(surface) == nullptr &&
           record.needed_integer(outer) == nullptr && record.needed_integer(holes) == nullptr &&
           outer == 0 && holes == 0;
  }

  // What a composite curve (102) lists, and the surface of an untrimmed 144.
  void find_children(const IgesEntry& parent) {
    bool is_whole = false;
    IgesRecord record = parameters_of(file_, parent, sink_, is_whole);
    int64_t count = 1, pointer = 0;
    if (is_whole && parent.type == 102)
      if (const char* wrong = record.needed_integer(count)) {
        bad_field(record, parent, "the count of its curves", wrong);
        return;
      }
    for (int64_t i = 0; is_whole && i < count; ++i) {
      if (const char* wrong = record.needed_integer(pointer)) {
        bad_field(record, parent, "pointer " + std::to_string(i) + " (from 0)", wrong);
        return;
      }
      const IgesEntry* child = iges_entry(file_, pointer);
      const bool is_nested = child != nullptr && child->type == 102;
      if (child == nullptr || child == &parent || (parent.type == 144 && child->type != 128) ||
          (is_nested && parent.matrix != 0)) {
        sink_.defect(record.line(), "child",
                     name_of(parent) + " is made of D " + std::to_string(pointer) + ", which is " +
                         (parent.type == 144 ? "no surface (128)" : "no single curve") +
                         ": export it again");
        return;
      }
      parents_.emplace(child, &parent);
    }
  }

  // The entity that moves this one by its transformation: its only parent, whose dependent it is.
  bool mover_of(const IgesEntry& entry, const IgesEntry*& mover) {
    mover = nullptr;
    const auto [begin, end] = parents_.equal_range(&entry);
    for (auto at = begin; at != end; ++at) {
      if (at->second->matrix == 0) continue;
      if (!entry.is_dependent || std::distance(begin, end) != 1)
        return sink_.defect(at->second->line, "parent",
                            name_of(*at->second) + " moves " + name_of(entry) +
                                ", which also stands alone or in another entity: export it "
                                "without a transformation");
      mover = at->second;
    }
    return true;
  }

  // The transformations of an entry, the nearest first, then its parent's.
  bool placement_of(const IgesEntry& entry, Placement& placement) {
    const IgesEntry* mover = nullptr;
    return mover_of(entry, mover) && add_matrices(entry, placement) &&
           (mover == nullptr || add_matrices(*mover, placement));
  }

  bool add_matrices(const IgesEntry& entry, Placement& placement) {
    const IgesEntry* of = &entry;
    std::set<const IgesEntry*> seen;
    while (of->matrix != 0) {
      const IgesEntry* matrix = iges_entry(file_, of->matrix);
      if (matrix == nullptr || matrix->type != 124)
        return sink_.defect(of->line, "matrix",
                            name_of(*of) + " is placed by D " + std::to_string(of->matrix) +
                                ", which is no transformation (124): export it again");
      if (!seen.insert(matrix).second)
        return sink_.defect(matrix->line, "matrix",
                            name_of(*matrix) + " is placed by itself: export it again");
      if (!add_matrix(*matrix, placement)) return false;
      of = matrix;
    }
    return true;
  }

  bool add_matrix(const IgesEntry& entry, Placement& placement) {
    bool is_whole = false;
    IgesRecord record = parameters_of(file_, entry, sink_, is_whole);
    std::vector<double> m;
    std::vector<uint64_t> lines;
    if (!is_whole || !numbers(record, entry, "matrix value", 12, m, lines)) return false;
    const Point a{m[0], m[1], m[2]}, b{m[4], m[5], m[6]}, c{m[8], m[9], m[10]};
    const double volume = dot(a, cross(b, c)), size = length(a) * length(b) * length(c);
    if (!(std::abs(volume) > 1e-9 * size) || !(size > 0))
      return bad(lines[0], entry, {"its matrix flattens what it places: export it again", 0});
    Placement both;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 4; ++k) {
        both.m[4 * i + k] = k == 3 ? m[4 * i + 3] : 0;
        for (size_t j = 0; j < 3; ++j) both.m[4 * i + k] += m[4 * i + j] * placement.m[4 * j + k];
      }
    }
    placement = both;
    return true;
  }

  const IgesFile& file_;
  SplineSink& sink_;
  std::multimap<const IgesEntry*, const IgesEntry*> parents_;  // of a child
  size_t passed_over_ = 0;
};

}  // namespace

void read_iges(std::string_view bytes, double unit_m, SplineSink& sink) {
  IgesFile file;
  if (!split_iges(bytes, sink, file) || !read_iges_global(sink, unit_m, file) ||
      !read_iges_directory(sink, file))
    return;
  Reader(file, sink).read();
}

}  // namespace firmtouch::tools
