#include "cli/model_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/input_kinds.hpp"
#include "curve/read_curve_csv.hpp"
#include "device/refused.hpp"
#include "field/wrap.hpp"
#include "spline/read_spline.hpp"
#include "surface/check/check.hpp"
#include "surface/edges.hpp"
#include "surface/read/read_surface.hpp"

namespace firmtouch::cli {
namespace {

constexpr struct {
  const char* name;
  double unit_m;
} kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}};

constexpr double kMaxOfDiagonal = 0.1, kGrowth = 1.5;  // of a wrapping that must join points

double unit_named(std::string_view name) {
  for (const auto& unit : kUnits)
    if (name == unit.name) return unit.unit_m;
  return 0;
}

// A number and what follows it. Result: false where there is no finite number.
bool read_leading(std::string_view text, double& value, std::string_view& rest) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  rest = text.substr(static_cast<size_t>(result.ptr - text.data()));
  return result.ec == std::errc() && std::isfinite(value);
}

// "0.15", "150mm" or, where a share is allowed, "1%".
Length length_of(const Arguments& arguments, const char* option, bool allows_share) {
  if (!arguments.has(option)) return {};
  const std::string text = arguments.text(option, "");
  Length length;
  std::string_view rest;
  const bool is_number = read_leading(text, length.value, rest);
  length.is_share = allows_share && rest == "%";
  const double unit_m = rest.empty() ? 1 : length.is_share ? 0.01 : unit_named(rest);
  length.value *= unit_m;
  if (!is_number || !(length.value > 0) || (length.is_share && length.value > 1))
    fail_usage(std::string(option) + " " + text + ": a length is needed, such as 0.15 (metres)" +
               (allows_share ? ", 2mm or 1% (of the model's diagonal)" : " or 150mm"));
  return length;
}

// "X,Y,Z" in metres.
tools::Point translation_of(const Arguments& arguments) {
  const std::string text = arguments.text("--translate", "0,0,0");
  double xyz[3] = {};
  std::string_view rest = text;
  for (int k = 0; k < 3; ++k) {
    const bool is_last = k == 2;
    if (!read_leading(rest, xyz[k], rest) || (is_last ? !rest.empty() : rest.substr(0, 1) != ","))
      fail_usage("--translate " + text + ": three numbers are needed: --translate X,Y,Z (metres)");
    rest.remove_prefix(is_last ? 0 : 1);
  }
  return {xyz[0], xyz[1], xyz[2]};
}

// "z:90".
void turn_by(const Arguments& arguments, tools::FileFrame& frame) {
  // What points up is turned to z; the other axes follow in their order.
  const std::string up = arguments.choice("--up", "z", {"x", "y", "z"});
  if (up == "y") tools::turn_about(frame, 0, 90);
  if (up == "x") tools::turn_about(frame, 1, -90);
  if (!arguments.has("--rotate")) return;
  const std::string text = arguments.text("--rotate", "");
  const size_t axis = text.size() > 2 && text[1] == ':' ? std::string("xyz").find(text[0]) : 3;
  double degrees = 0;
  std::string_view rest;
  if (axis > 2 || !read_leading(std::string_view(text).substr(2), degrees, rest) || !rest.empty() ||
      std::fabs(degrees) > 360)
    fail_usage("--rotate " + text + ": an axis and degrees are needed, such as --rotate z:90");
  tools::turn_about(frame, static_cast<int>(axis), degrees);
}

[[noreturn]] void fail_with(const std::string& path, const std::vector<std::string>& refused) {
  std::string all;
  for (const std::string& line : refused)
    all += (all.empty() ? "" : "\n" + std::string(11, ' ')) + path + ": " + line;
  fail_input(all);
}

uint32_t pieces_of(const tools::Surface& surface) {
  tools::Sets sets(surface.vertices.size());
  for (const tools::Face& face : surface.faces) {
    sets.join(face[0], face[1]);
    sets.join(face[0], face[2]);
  }
  uint32_t pieces = 0;
  for (uint32_t v = 0; v < surface.vertices.size(); ++v) pieces += sets.find(v) == v ? 1u : 0u;
  return pieces;
}

struct Wrapping {
  tools::Surface surface;
  double distance_m = 0;
  size_t voids = 0;
  uint32_t pieces = 0;
  int64_t handles = 0;  // of a closed surface, by its Euler characteristic
};

Wrapping wrapping_of(const std::string& path, const tools::Surface& soup, double distance_m) {
  tools::WrapReport report;
  Wrapping found;
  found.surface = tools::wrap_surface(soup, distance_m, report);
  if (!report.problem.empty()) fail_input(path + ": " + report.problem);
  found.distance_m = distance_m;
  found.voids = report.voids;
  found.pieces = pieces_of(found.surface);
  const int64_t vertices = static_cast<int64_t>(found.surface.vertices.size());
  const int64_t edges_less_faces = static_cast<int64_t>(found.surface.faces.size() / 2);
  found.handles = int64_t{found.pieces} - (vertices - edges_less_faces) / 2;
  return found;
}

// Points are joined: a share of the diagonal grows until the surface is one piece, and a wider one
// has as many handles and closes no hollow, so that none is a gap between points.
Wrapping joined_points(const std::string& path, const tools::Surface& points, double distance_m,
                       double max_m) {
  Wrapping found = wrapping_of(path, points, distance_m);
  while (found.distance_m < max_m) {
    Wrapping wider = wrapping_of(path, points, std::min(found.distance_m * kGrowth, max_m));
    const bool closes = wider.voids > 0 && found.voids == 0;
    if (found.pieces == 1 && wider.handles == found.handles && !closes) break;
    found = std::move(wider);
  }
  return found;
}

SoundSurface wrapped_surface(const std::string& path, const tools::Surface& soup,
                             const Length& wrap) {
  const Extent extent = tools::extent_of(soup);
  const double diagonal_m = tools::length(extent.high - extent.low);
  const bool is_points = soup.faces[0][0] == soup.faces[0][1];
  const double distance_m = wrap.is_share ? wrap.value * diagonal_m : wrap.value;
  if (!(diagonal_m > 0)) fail_input(path + ": is one point: nothing can be wrapped");
  Wrapping wrapped = is_points && wrap.is_share
                         ? joined_points(path, soup, distance_m, kMaxOfDiagonal * diagonal_m)
                         : wrapping_of(path, soup, distance_m);
  tools::CheckReport checked = tools::check_and_mend(wrapped.surface, {});
  if (!checked.usable()) fail_with(path, checked.refused);
  SoundSurface sound{std::move(wrapped.surface), std::move(checked.vertex_source), {}};
  const tools::FileFrame& frame = soup.frame;
  sound.reported.push_back(
      "wrapped: " + std::to_string(soup.faces.size()) + (is_points ? " points" : " triangles") +
      " in a surface " + frame.length_text(wrapped.distance_m) + " away, of " +
      std::to_string(sound.surface.faces.size()) + " triangles in " +
      std::to_string(wrapped.pieces) + (wrapped.pieces == 1 ? " piece" : " pieces") +
      (is_points ? " with " + std::to_string(wrapped.handles) + " handles" : "") +
      ": closed, manifold, and no point lies outside it" +
      (wrapped.voids == 0 ? "" : "; hollows that the outside cannot reach are filled"));
  return sound;
}

// Of the triangles of the file, whose numbers the surface's `source` keeps.
void add_materials(const std::string& path, const ModelOptions& options,
                   tools::Imported& imported) {
  try {
    if (options.material_numbers.empty()) {
      imported.surface.material =
          tools::triangle_materials(path, imported.materials, options.materials);
    } else {
      const std::vector<uint8_t> text = read_model(options.material_numbers);
      imported.surface.material = tools::read_triangle_materials(
          options.material_numbers, {reinterpret_cast<const char*>(text.data()), text.size()},
          imported.surface.faces.size(), options.materials);
    }
  } catch (const tools::Refused& refused) {
    fail_input(refused.what());
  }
}

}  // namespace

Extent extent_of(const std::string& path, const ModelOptions& options) {
  const tools::FileFrame frame = options.frame_for(path);
  Extent extent;
  if (is_curve_file(path)) {
    for (const math::Vec3 p :
         tools::read_curve_csv(path, frame, {options.has_decimal_commas}).samples_m)
      extent.add(tools::to_point(p));
  } else if (is_spline_file(path)) {
    const tools::SplineModel model =
        tools::read_spline_file(path, frame.has_unit ? frame.unit_m : 0);
    const auto add = [&](const std::vector<tools::ControlPoint>& points) {
      for (const tools::ControlPoint& p : points) extent.add(frame.placed({p.x, p.y, p.z}));
    };
    for (const tools::SplineCurve& curve : model.curves) add(curve.points);
    for (const tools::SplineSurface& surface : model.surfaces) add(surface.points);
  } else {
    extent = tools::extent_of(tools::read_surface(path, frame, tools::PointsAre::kTaken).surface);
  }
  return extent;
}

tools::FileFrame ModelOptions::frame_for(const std::string& path) const {
  const auto own = frame_of.find(path);
  tools::FileFrame placed = frame;
  placed.offset_m = placed.offset_m - origin_m;
  if (own == frame_of.end()) return placed;
  placed.unit_m = own->second.unit_m;
  placed.unit = own->second.unit;
  placed.has_unit = true;
  return placed;
}

std::vector<Option> with_model_options(std::vector<Option> own) {
  static const std::vector<Option> kShared = {
      {"--unit", "m|mm|cm|in",
       "of the inputs' coordinates (default m; .igs .3mf: their own); INPUT:mm for one alone"},
      {"--scale", "FACTOR", "after the unit"},
      {"--up", "x|y|z", "which axis of the file points up; it becomes z"},
      {"--rotate", "AXIS:DEGREES", "about the origin, such as z:90; after --up"},
      {"--size", "LENGTH",
       "the first model's largest side becomes so long, such as 150mm; all inputs scale alike"},
      {"--centre", nullptr, "the middle of the first model's box comes to the origin"},
      {"--translate", "X,Y,Z", "metres, after all else"},
      {"--close-holes", nullptr, "each hole of a mesh gets a cap of triangles, reported"},
      {"--mend", nullptr,
       "meshes: weld what lies near, part sheets that touch, drop dangling faces, close holes"},
      {"--wrap", "LENGTH",
       "meshes: a surface around them at this distance, such as 2mm or 1% (of the diagonal); "
       "with --mend only where that is not enough; takes soups and points"}};
  own.insert(own.begin() + 1, kShared.begin(), kShared.end());
  return own;
}

ModelOptions model_options(const Arguments& arguments, std::string& text) {
  ModelOptions options;
  const std::string unit = arguments.choice("--unit", "m", {"m", "mm", "cm", "in"});
  options.frame = tools::FileFrame(unit_named(unit));
  options.frame.has_unit = arguments.has("--unit");
  options.frame.scale = arguments.number("--scale", 1, 1e-12);
  turn_by(arguments, options.frame);
  options.frame.offset_m = translation_of(arguments);
  options.size_m = length_of(arguments, "--size", false).value;
  options.centre = arguments.has("--centre");
  options.is_signed = !arguments.has("--unsigned");
  options.close_holes = arguments.has("--close-holes");
  options.mend = arguments.has("--mend");
  options.has_decimal_commas = arguments.has("--decimal-comma");
  options.wrap = length_of(arguments, "--wrap", true);
  if (!options.is_signed && options.wrap.value > 0)
    fail_usage("--wrap gives an inside and --unsigned does without one; give one of them");
  text += "--unit " + unit;
  for (const char* option : {"--scale", "--up", "--rotate", "--size", "--translate", "--wrap"})
    if (arguments.has(option)) text += std::string(" ") + option + " " + arguments.text(option, "");
  for (const char* option :
       {"--centre", "--unsigned", "--close-holes", "--mend", "--decimal-comma"})
    if (arguments.has(option)) text += std::string(" ") + option;
  return options;
}

std::vector<std::string> inputs_with_units(const std::vector<std::string>& words,
                                           ModelOptions& options) {
  std::vector<std::string> paths;
  for (const std::string& word : words) {
    const size_t colon = word.rfind(':');
    const double unit_m = colon == word.npos ? 0 : unit_named(word.substr(colon + 1));
    std::error_code error;
    if (!(unit_m > 0) || std::filesystem::exists(word, error)) {
      paths.push_back(word);
      continue;
    }
    paths.push_back(word.substr(0, colon));
    options.frame_of[paths.back()] = tools::FileFrame(unit_m);
  }
  return paths;
}

void settle_size(const std::string& path, ModelOptions& options) {
  if (!(options.size_m > 0) && !options.centre) return;
  forbid_pipe(path);
  const tools::Point moved_m = options.frame.offset_m;
  options.frame.offset_m = {};
  const Extent extent = extent_of(path, options);
  const tools::Point side = extent.high - extent.low;
  const double size_m = std::max({side.x, side.y, side.z});
  const double factor = options.size_m > 0 && size_m > 0 ? options.size_m / size_m : 1;
  if (std::isfinite(size_m)) {
    options.frame.scale *= factor;
    if (options.centre) options.frame.offset_m = (extent.low + extent.high) * (-factor / 2);
  }
  options.frame.offset_m = options.frame.offset_m + moved_m;
}

SoundSurface sound_surface(const std::string& path, std::vector<uint8_t> bytes,
                           const ModelOptions& options) {
  const bool wraps = options.wrap.value > 0, has_materials = !options.materials.table.empty();
  tools::Imported imported = tools::read_surface_bytes(
      {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, options.frame_for(path),
      wraps ? tools::PointsAre::kTaken : tools::PointsAre::kRefused,
      has_materials ? tools::MaterialsAre::kRead : tools::MaterialsAre::kPassedOver);
  bytes = {};  // a large model needs the memory
  if (!imported.problem.empty()) fail_input(imported.problem);
  if (has_materials) add_materials(path, options, imported);
  tools::CheckOptions checks;
  checks.allow_unsigned = !options.is_signed;
  checks.close_holes = options.close_holes;
  checks.mend = options.mend;
  SoundSurface sound;
  if (wraps && !options.mend) {
    sound = wrapped_surface(path, imported.surface, options.wrap);
  } else {
    tools::Surface surface = wraps ? imported.surface : std::move(imported.surface);
    const tools::CheckReport report = tools::check_and_mend(surface, checks);
    if (report.usable()) {
      sound = {std::move(surface), report.vertex_source, {}};
      for (const std::string& line : report.mended) sound.reported.push_back("mended: " + line);
      for (const std::string& line : report.kept) sound.reported.push_back("kept: " + line);
    } else if (wraps) {
      sound = wrapped_surface(path, imported.surface, options.wrap);
      sound.reported.push_back("mending alone was not enough: " + report.refused[0]);
    } else {
      fail_with(path, report.refused);
    }
  }
  for (const std::string& line : imported.notes) sound.reported.push_back("read: " + line);
  return sound;
}

}  // namespace firmtouch::cli
