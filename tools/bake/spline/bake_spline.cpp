#include "bake/spline/bake_spline.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bake/asset/asset_views.hpp"
#include "bake/spline/spline_tree.hpp"

namespace firmtouch::tools {
namespace {

// As open() requires (rule R607), less what rounding of the sum may take.
constexpr double kMaxLoss = 1.98 * 0x1p-24, kMaxRationalLoss = 4.98 * 0x1p-24;
constexpr size_t kMaxPieces = 20000;
constexpr int kMaxCuts = 3;  // of a piece, for the sake of its weights

struct Bounds {
  double low_m[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
  double high_m[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  void add(const Point& p) {
    const double at[3] = {p.x, p.y, p.z};
    for (size_t k = 0; k < 3; ++k) {
      low_m[k] = std::min(low_m[k], at[k]);
      high_m[k] = std::max(high_m[k], at[k]);
    }
  }
  double longest_m() const {
    return std::max({high_m[0] - low_m[0], high_m[1] - low_m[1], high_m[2] - low_m[2]});
  }
};

// Of points of the shape itself: never more than its extent.
Bounds sampled(const std::vector<BezierPatch>& patches, bool is_surface) {
  Bounds bounds;
  for (const BezierPatch& patch : patches)
    for (int j = 0; j <= (is_surface ? 8 : 0); ++j)
      for (int i = 0; i <= 16; ++i) bounds.add(point_at(patch, i / 16.0, is_surface ? j / 8.0 : 0));
  return bounds;
}

std::vector<BezierPatch> patches_of(const SplineModel& model) {
  std::vector<BezierPatch> patches;
  for (const SplineCurve& curve : model.curves)
    for (const BezierCurve& piece : bezier_pieces(curve)) patches.push_back(as_patch(piece));
  for (const SplineSurface& surface : model.surfaces)
    for (const BezierPatch& piece : bezier_pieces(surface))
      patches.push_back(surface.is_turned ? turned_over(piece) : piece);
  return patches;
}

double thickness_of(const spline::LeafShape& shape) {  // all but its linear part
  double sum = 0;
  for (uint32_t j = 0; j <= shape.degree_v; ++j)
    for (uint32_t i = 0; i <= shape.degree_u; ++i)
      if (i + j > 1) sum += length(to_point(shape.c[j * (shape.degree_u + 1) + i]));
  return sum;
}

// How much the second derivatives of D^2 / 2 may change from the middle to the edge of a leaf, on
// which the query lies, against what they are there, on the axis where that is most.
double doubt_of(const spline::LeafShape& shape, const StoredPiece& stored, uint32_t level_u,
                uint32_t level_v) {
  const auto wide = [](float value) { return static_cast<double>(value); };
  const double reach = std::ldexp(1.0, -static_cast<int>(level_u));
  const Point u = to_point(shape.c[1]) * (1 / reach);
  const double uu = dot(u, u);
  if (stored.piece.degree_v == 0) return 0;
  const double reach_v = std::ldexp(1.0, -static_cast<int>(level_v));
  const Point v = to_point(shape.c[shape.degree_u + 1]) * (1 / reach_v);
  const double vv = dot(v, v);
  if (!(uu > 0 && vv > 0)) return HUGE_VAL;
  return std::max((wide(shape.fixed[0]) * reach / 3 + wide(shape.fixed[1]) * reach_v) / uu,
                  (wide(shape.fixed[3]) * reach_v / 3 + wide(shape.fixed[2]) * reach) / vv);
}

bool is_fine(const StoredPiece& stored, uint32_t level_u, uint32_t level_v,
             const SplineDetail& detail, double extent_m) {
  for (uint32_t v = 0; v < 1u << level_v; ++v)
    for (uint32_t u = 0; u < 1u << level_u; ++u) {
      const spline::LeafShape shape = shape_of(stored, level_u, u, level_v, v);
      if (!(shape.min_weight > 0.0f)) return false;
      if (thickness_of(shape) > detail.thickness * extent_m) return false;
      if (doubt_of(shape, stored, level_u, level_v) > detail.doubt) return false;
    }
  return true;
}

// The longer way across is halved first.
void choose_levels(StoredPiece& stored, const SplineDetail& detail, double extent_m) {
  uint32_t level_u = 0, level_v = 0;
  while (!is_fine(stored, level_u, level_v, detail, extent_m)) {
    const spline::LeafShape shape =
        shape_of(stored, level_u, (1u << level_u) / 2, level_v, (1u << level_v) / 2);
    const bool can_u = level_u < detail.max_halvings;
    const bool can_v = stored.piece.degree_v != 0 && level_v < detail.max_halvings;
    if (!can_u && !can_v) break;
    bool halve_v = !can_u;
    if (can_u && can_v)
      halve_v = length(to_point(shape.c[shape.degree_u + 1])) > length(to_point(shape.c[1]));
    (halve_v ? level_v : level_u) += 1;
  }
  stored.piece.level_u = static_cast<uint8_t>(level_u & 15u);
  stored.piece.level_v = static_cast<uint8_t>(level_v & 15u);
}

// Of a piece's points, at its levels; NaN where a weight varies too much on a leaf.
double loss_of(const StoredPiece& stored) {
  double worst = 0;
  for (uint32_t v = 0; v < 1u << stored.piece.level_v; ++v)
    for (uint32_t u = 0; u < 1u << stored.piece.level_u; ++u) {
      const spline::LeafShape shape =
          shape_of(stored, stored.piece.level_u, u, stored.piece.level_v, v);
      if (!(shape.min_weight > 0.0f)) return HUGE_VAL;
      worst = std::max(worst, static_cast<double>(shape.loss_m));
    }
  return worst + stored.deviation_m;
}

// How much of the second derivative of D^2 / 2 in the middle of a curve's piece, seen from a tenth
// of the extent, the fourth may take away at its ends: where weights vary, more than the whole.
double doubt_of(const StoredPiece& stored, double extent_m) {
  const spline::CurveBend bend = curve_bend_of(stored);
  const spline::LeafShape whole = shape_of(stored, 0, 0, 0, 0);
  const Point along = to_point(whole.c[1]);
  const double fourth =
      static_cast<double>(bend.fixed_m2) + static_cast<double>(bend.turning_m) * 0.1 * extent_m;
  return fourth / (12 * dot(along, along));
}

// The longer way across is halved, by all terms of the piece: the first alone vanishes where it
// folds back. Where a weight varies too much on a leaf, the way along which weights vary most.
bool is_halved_in_v(const StoredPiece& stored, double loss_m) {
  const bool is_rational = stored.piece.is_rational != 0;
  const bool is_by_weight = is_rational && !(loss_m < HUGE_VAL);
  const size_t columns = size_t{stored.piece.degree_u} + 1, width = is_rational ? 4 : 3;
  double along_u = 0, along_v = 0;
  for (size_t k = 1; k * width < stored.coefficients.size(); ++k) {
    const float* const c = &stored.coefficients[k * width];
    const double size = is_by_weight ? std::fabs(static_cast<double>(c[3]))
                                     : length(to_point(math::Vec3{c[0], c[1], c[2]}));
    if (k % columns != 0) along_u += size;
    if (k >= columns) along_v += size;
  }
  return along_v > along_u;
}

// Pieces short enough that float32 loses no more than is promised, and that a point bounds much of
// those about it.
std::vector<StoredPiece> cut(std::vector<BezierPatch> patches, bool is_surface,
                             const SplineDetail& detail, double extent_m, double max_m) {
  std::vector<StoredPiece> pieces;
  std::reverse(patches.begin(), patches.end());  // a stack, its top the first
  std::vector<int> cuts(patches.size(), 0);
  while (!patches.empty() && pieces.size() + patches.size() < kMaxPieces) {
    const BezierPatch patch = patches.back();
    const int made = cuts.back();
    patches.pop_back();
    cuts.pop_back();
    StoredPiece stored = store_piece(patch, is_surface);
    choose_levels(stored, detail, extent_m);
    const bool is_doubtful = !is_surface && stored.piece.is_rational != 0 && made < kMaxCuts &&
                             !(doubt_of(stored, extent_m) <= detail.doubt);
    const double loss_m = loss_of(stored);
    if (loss_m <= max_m && !is_doubtful) {
      pieces.push_back(stored);
      continue;
    }
    const bool along_v = is_surface && is_halved_in_v(stored, loss_m);
    const std::vector<BezierPatch> halves = halves_of(patch, along_v);
    patches.push_back(halves[1]);
    patches.push_back(halves[0]);
    cuts.insert(cuts.end(), 2, made + 1);
  }
  if (!patches.empty()) pieces.clear();
  return pieces;
}

spline::Head make_head(const std::vector<StoredPiece>& pieces, const SplineTree& tree,
                       bool is_surface, bool is_rational, double extent_m) {
  spline::Head head{};
  head.is_surface = is_surface ? 1 : 0;
  head.is_rational = is_rational ? 1 : 0;
  head.piece_count = static_cast<uint32_t>(pieces.size());
  head.point_count = static_cast<uint32_t>(tree.points_m.size());
  head.radius_unit_m = tree.radius_unit_m;
  for (size_t k = 0; k < 3; ++k) {
    head.low_m[k] = HUGE_VALF;
    head.high_m[k] = -HUGE_VALF;
  }
  double loss_m = 0;
  for (const StoredPiece& stored : pieces) {
    head.leaf_count += 1u << (stored.piece.level_u + stored.piece.level_v);
    head.coefficient_count += static_cast<uint32_t>(stored.coefficients.size());
    loss_m = std::max(loss_m, loss_of(stored));
    for (uint32_t v = 0; v < 1u << stored.piece.level_v; ++v)
      for (uint32_t u = 0; u < 1u << stored.piece.level_u; ++u) {
        const spline::LeafShape shape =
            shape_of(stored, stored.piece.level_u, u, stored.piece.level_v, v);
        const math::Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (size_t k = 0; k < 3; ++k) {
          const spline::Extent e = spline::extent_along(shape, {}, axes[k]);
          head.low_m[k] = std::min(head.low_m[k], e.low);
          head.high_m[k] = std::max(head.high_m[k], e.high);
        }
      }
  }
  for (const math::Vec3& p : tree.points_m) {
    const float at_m[3] = {p.x, p.y, p.z};
    for (size_t k = 0; k < 3; ++k) {
      head.low_m[k] = std::min(head.low_m[k], at_m[k]);
      head.high_m[k] = std::max(head.high_m[k], at_m[k]);
    }
  }
  if (!is_surface) head.leaf_count = static_cast<uint32_t>(tree.leaves.size());
  head.extent_m = static_cast<float>(extent_m * (1 - 1e-6));
  head.loss_m = static_cast<float>(loss_m * (1 + 1e-6));
  head.worst_steps = 1;
  return head;
}

// In a plane of one z, as they are stored.
bool is_flat(const std::vector<StoredPiece>& pieces) {
  for (const StoredPiece& stored : pieces) {
    const float off_m = stored.piece.origin_m[2] - pieces[0].piece.origin_m[2];
    if (off_m < 0 || off_m > 0) return false;
    for (size_t k = 2; k < stored.coefficients.size(); k += stored.piece.is_rational != 0 ? 4 : 3)
      if (stored.coefficients[k] < 0 || stored.coefficients[k] > 0) return false;
  }
  return true;
}

// x and y of all, and behind them their z.
std::vector<float> stored_points(const std::vector<math::Vec3>& points_m, bool is_flat) {
  std::vector<float> stored;
  for (const math::Vec3& p : points_m) {
    stored.push_back(p.x);
    stored.push_back(p.y);
  }
  for (size_t i = 0; i < points_m.size() && !is_flat; ++i) stored.push_back(points_m[i].z);
  return stored;
}

// Of a tree over so many, and of the deepest piece below it.
uint32_t levels_of(const std::vector<StoredPiece>& pieces, uint32_t count) {
  uint32_t levels = 0, deepest = 0;
  for (uint32_t nodes = 2 * count - 1; nodes != 0; nodes /= 2) ++levels;
  for (const StoredPiece& stored : pieces)
    if (stored.piece.degree_v != 0)
      deepest = std::max(deepest, 0u + stored.piece.level_u + stored.piece.level_v);
  return levels + deepest;
}

std::string input_problem(const SplineModel& model, const std::vector<BezierPatch>& patches,
                          const Bounds& bounds) {
  if (!model.problem.empty()) return model.problem;
  if (!model.curves.empty() && !model.surfaces.empty())
    return "holds both curves and surfaces, of which one asset takes one kind: export them to two "
           "files";
  if (patches.empty()) return "holds no curve or surface that has any extent";
  for (const BezierPatch& patch : patches)
    if (std::max(patch.degree_u, patch.degree_v) > static_cast<int>(spline::kMaxDegree))
      return "entity " + std::to_string(patch.piece) +
             " is of a degree above 5; approximate it by "
             "cubics in the CAD program";
  for (size_t k = 0; k < 3; ++k)
    if (!(bounds.low_m[k] >= -0.999 * static_cast<double>(spline::kMaxCoordinate_m) &&
          bounds.high_m[k] <= 0.999 * static_cast<double>(spline::kMaxCoordinate_m)))
      return "reaches more than 1e6 m from the origin; check --unit";
  if (!(bounds.longest_m() >= 1.01 * static_cast<double>(spline::kMinExtent_m)))
    return "is smaller than 1e-6 m; check --unit";
  return "";
}

}  // namespace

SplineDetail curve_detail(bool is_small) {
  SplineDetail detail;
  if (is_small) detail.thickness = 0.016, detail.doubt = 8;
  return detail;
}

SplineDetail surface_detail(bool is_small) {
  SplineDetail detail;
  detail.thickness = is_small ? 0.1 : 0.0034;
  detail.doubt = 100;
  detail.max_halvings = is_small ? 1 : 3;
  detail.cell_level = is_small ? 0 : 1;
  return detail;
}

// The sections of a tree of leaves (curves) or of grids (surfaces), behind those of the pieces.
static void add_search_sections(const SplineTree& tree, const SplineGrids& grids,
                                bool is_flat_curve, const std::string& name,
                                std::vector<Section>& sections) {
  if (!grids.grids.empty()) {
    sections.push_back(make_section(spline::kGridsSection, name, grids.grids));
    sections.push_back(make_section(spline::kPointsSection, name, grids.corners));
    sections.push_back(make_section(spline::kRadiiSection, name, grids.radii));
    sections.push_back(make_section(spline::kBendsSection, name, grids.bends));
    if (!grids.boxes.empty())
      sections.push_back(make_section(spline::kNodesSection, name, grids.boxes));
    return;
  }
  sections.push_back(make_section(spline::kLeavesSection, name, tree.leaves));
  sections.push_back(make_section(spline::kBendsSection, name, tree.bends));
  sections.push_back(
      make_section(spline::kPointsSection, name, stored_points(tree.points_m, is_flat_curve)));
  sections.push_back(make_section(spline::kRadiiSection, name, tree.radii));
}

std::vector<Section> bake_spline(const SplineModel& model, const std::string& name,
                                 const SplineDetail& detail, SplineReport& report) {
  report = {};
  const std::vector<BezierPatch> patches = patches_of(model);
  const bool is_surface = !model.surfaces.empty();
  const Bounds bounds = sampled(patches, is_surface);
  report.problem = input_problem(model, patches, bounds);
  if (!report.problem.empty()) return {};
  report.is_surface = is_surface;
  report.entities = static_cast<uint32_t>(model.curves.size() + model.surfaces.size());
  report.is_planar = !is_surface;
  for (const SplineCurve& curve : model.curves) report.is_planar &= curve.is_planar;
  for (const BezierPatch& patch : patches) report.is_rational |= is_rational(patch.points);
  report.extent_m = bounds.longest_m();

  const double max_m = report.extent_m * (report.is_rational ? kMaxRationalLoss : kMaxLoss);
  std::vector<StoredPiece> pieces = cut(patches, is_surface, detail, report.extent_m, max_m);
  size_t parts = 0;
  for (const StoredPiece& stored : pieces)
    parts += size_t{1} << (stored.piece.level_u + stored.piece.level_v);
  if (pieces.empty() || parts > spline::kMaxLeaves) {
    report.problem =
        (pieces.empty() ? "needs more than " + std::to_string(kMaxPieces) + " pieces"
                        : "needs " + std::to_string(parts) + " parts, but an asset holds " +
                              std::to_string(spline::kMaxLeaves)) +
        ": split the file, or bake with --small" +
        (report.is_rational ? "; weights that differ less need fewer" : "");
    return {};
  }
  SplineTree tree;
  SplineGrids grids;
  if (is_surface)
    grids = build_spline_grids(pieces, detail.cell_level);
  else
    tree = build_spline_tree(pieces);
  if (tree.leaves.empty() && grids.grids.empty()) {
    report.problem = "turns too sharply for its size: its derivatives leave the range of float32";
    return {};
  }
  spline::Head head = make_head(pieces, tree, is_surface, report.is_rational, report.extent_m);
  if (is_surface) head.point_count = static_cast<uint32_t>(grids.corners.size());
  std::vector<spline::Piece> stored_pieces;
  std::vector<float> coefficients;
  for (StoredPiece& stored : pieces) {
    stored.piece.coefficients = static_cast<uint32_t>(coefficients.size());
    coefficients.insert(coefficients.end(), stored.coefficients.begin(), stored.coefficients.end());
    stored_pieces.push_back(stored.piece);
    report.deviation_m = std::max(report.deviation_m, stored.deviation_m);
  }
  std::vector<Section> sections;
  sections.push_back(make_section(spline::kHeadSection, name, &head, 1));
  sections.push_back(make_section(spline::kPiecesSection, name, stored_pieces));
  sections.push_back(make_section(spline::kCoefficientsSection, name, coefficients));
  add_search_sections(tree, grids, is_flat(pieces), name, sections);
  for (const Section& section : sections) report.bytes += section.bytes.size();
  report.pieces = head.piece_count;
  report.leaves = head.leaf_count;
  report.levels = levels_of(pieces, is_surface ? head.piece_count : head.leaf_count);
  report.loss_m = static_cast<double>(head.loss_m);

  spline::View view;
  const core::Verdict verdict = open_baked(sections, name, view);
  if (!verdict.ok()) {
    report.problem = "the baked spline breaks " + rule_text(verdict) +
                     ": this is a defect of the baker; please report it with the file";
    return {};
  }
  return sections;
}

void set_worst_steps(std::vector<Section>& sections, const std::string& name, uint32_t steps) {
  for (Section& section : sections)
    if (section.type == spline::kHeadSection && section.name == name)
      std::memcpy(section.bytes.data() + offsetof(spline::Head, worst_steps), &steps, sizeof steps);
}

}  // namespace firmtouch::tools
