#include "bake/asset/origin.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/queries.hpp"

namespace firmtouch::cli {
namespace {

const std::vector<std::string> kPoint = {"x", "y", "z"};
const std::vector<std::string> kSegment = {"ax", "ay", "az", "bx", "by", "bz"};
const std::vector<std::string> kRay = {"ax", "ay", "az", "dx", "dy", "dz"};
const std::vector<std::string> kTriangle = {"ax", "ay", "az", "bx", "by", "bz", "cx", "cy", "cz"};

// Of a hull.
const std::vector<std::string>& columns_of(const Arguments& arguments) {
  const std::string primitive = primitive_of(arguments);
  return primitive == "ray" ? kRay : primitive == "triangle" ? kTriangle : kSegment;
}

void forbid(const Arguments& arguments, const std::string& kind,
            const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    if (arguments.has(option))
      fail_usage("query: " + option + " has no meaning for " + kind + "; leave it out");
  }
}

void check_kind(const std::string& kind) {
  for (const char* known : {"distance", "segment", "hull", "curve", "spline", "footpoints"}) {
    if (kind == known) return;
  }
  fail_usage("query: '" + kind +
             "' is no kind of query; give distance, segment, hull, curve, spline or footpoints");
}

// Before anything is read: a bad option is a usage error whatever the files are.
void check_options(const Arguments& arguments, const std::string& kind) {
  (void)budget_of(arguments);
  if (kind == "curve") (void)curve_options_of(arguments);
  if (kind == "hull") check_hull_options(arguments);
}

// The origin on each column's axis; of a direction 0.
std::vector<double> shift_of(const std::vector<std::string>& columns,
                             const tools::Point& origin_m) {
  std::vector<double> shift;
  if (!tools::is_moved(origin_m)) return shift;
  for (const std::string& column : columns) {
    const char axis = column.back();
    const double x_m = axis == 'x' ? origin_m.x : axis == 'y' ? origin_m.y : origin_m.z;
    shift.push_back(column[0] == 'd' ? 0 : x_m);
  }
  return shift;
}

CsvTable query_rows(const std::vector<std::string>& columns, const LoadedAsset& asset,
                    const Arguments& arguments) {
  const std::vector<double> shift = shift_of(columns, asset.origin_m());
  if (arguments.has("--line-buffered")) return read_csv_lines(columns, shift);
  CsvTable table = read_csv(read_standard_input(), "standard input", columns, shift);
  if (arguments.has("--time") && table.rows() == 0)
    fail_input("standard input: no rows after the header, so there is nothing to time; add some");
  return table;
}

}  // namespace

Command query_command() {
  return {
      {"query",
       "ASSET.fta NAME distance|segment|hull|curve|spline|footpoints [options] < IN.csv > OUT.csv",
       3, 3, run_query},
      "Answers each row of a CSV as the controller would, bit for bit.",
      R"(in:  distance, curve, spline, footpoints: header x,y,z
     segment, hull: header ax,ay,az,bx,by,bz     (metres)
     hull --primitive ray: ax,ay,az,dx,dy,dz; triangle: ax,ay,az,bx,by,bz,cx,cy,cz
out: distance: distance,sign,cx,cy,cz,nx,ny,nz,triangle,feature,lower,steps,exact
               (negative inside; sign 0: unknown; lower: no point of the surface is nearer;
               exact 0: the work ended first, or floats cannot say on which side the point is)
     segment, hull: hit,t,triangle,steps,exact
               (the first crossing from a to b; -1: no triangle; exact 0: the work ended before it
               was certain, or the row is not finite)
     hull --primitive ray: t in lengths of its direction; triangle: hit,triangle,steps,exact
               (the lowest that it crosses); --all: asked,triangle
     curve:    distance,cx,cy,cz,segment,arc,lower,steps,exact
     spline:   distance,cx,cy,cz,piece,u,v,lower,steps,exact
               (piece: of the file, from 0; u, v: its own)
     footpoints: point,kind,distance,cx,cy,cz,piece,u,v   (a row a foot-point of a spline, nearest
               first; kind: min, max, saddle or end, which is an end, a corner or of a border; in
               double, on this machine alone)
Rows are answered in order, each warm-started by the one before.)",
      {{"--cold", nullptr, "each row on its own"},
       {"--work", "N",
        "at most N work units a query, of about 100 instructions of a Cortex-M7 (default: "
        "unlimited)"},
       {"--budget", "N", "the same in visits of 2.5 units; dropped in the next version"},
       {"--time", nullptr, "no rows: median processor time a query, of 5 passes"},
       {"--json", nullptr, "a JSON object a row, instead of CSV"},
       {"--npy", nullptr, "a NumPy file of records with the columns' names, instead of CSV"},
       {"--line-buffered", nullptr,
        "each row is answered before the next one is read, for a program at both ends"},
       {"--isa", "LEVEL",
        "distance, segment: instruction set: scalar, x86-64-v2, -v3, -v4 or neon (default: the "
        "fastest here); the answers are the same"},
       {"--mode", "MODE",
        "curve: exact (default) or nearest, of the N nearest samples; hull: complete (default): "
        "misses nothing, or refine: splits the hull where it is crossed"},
       {"--n", "N", "curve, nearest: samples looked at, 1 to 100 (default 10)"},
       {"--arc-penalty", "W",
        "curve: metres of distance for the whole length's change of arc since the row before "
        "(default "
        "0); lower then bounds distance and penalty together"},
       {"--band", "M", "distance: beyond M metres only a lower bound, in fewer steps (not exact)"},
       {"--all", nullptr,
        "segment, hull: every crossing, a row each (segment,t,triangle), in order of t"},
       {"--primitive", "KIND", "hull: segment (default), ray or triangle"},
       {"--base", "N",
        "hull, refine: faces that a segment meets at first (default: the coarsest)"}}};
}

int run_query(const Arguments& arguments) {
  const std::string& path = arguments.positionals()[0];
  const std::string& name = arguments.positionals()[1];
  const std::string& kind = arguments.positionals()[2];
  check_kind(kind);
  if (arguments.has("--line-buffered") && arguments.has("--time"))
    fail_usage("query: --time needs all rows at once: leave out --line-buffered");
  for (const char* other : {"--json", "--line-buffered", "--time"})
    if (arguments.has("--npy") && arguments.has(other))
      fail_usage(std::string("query: --npy is one file of all rows: leave out ") + other);
  if (kind == "footpoints") forbid(arguments, kind, {"--budget", "--work", "--cold"});
  if (kind != "segment" && kind != "hull") forbid(arguments, kind, {"--all"});
  if (kind != "curve" && kind != "hull") forbid(arguments, kind, {"--mode"});
  if (kind != "curve") forbid(arguments, kind, {"--n", "--arc-penalty"});
  if (kind != "hull") forbid(arguments, kind, {"--base", "--primitive"});
  if (kind == "curve" && arguments.text("--mode", "exact") == "exact") {
    forbid(arguments, "--mode exact", {"--n"});
  }
  if (kind != "distance" && kind != "segment") forbid(arguments, kind, {"--isa"});
  check_options(arguments, kind);
  choose_isa(arguments);
  const LoadedAsset asset(path);
  if (kind == "curve") {
    const LoadedCurve curve = asset.curve(name);
    query_curve(curve, asset.origin_m(), query_rows(kPoint, asset, arguments), arguments);
    return kDone;
  }
  if (kind == "hull") {
    const LoadedHull hull = asset.hull(name);
    query_hull(hull, query_rows(columns_of(arguments), asset, arguments), arguments);
    return kDone;
  }
  if (kind == "footpoints") {
    query_footpoints(asset.spline(name), asset.origin_m(), query_rows(kPoint, asset, arguments),
                     arguments);
    return kDone;
  }
  if (kind == "spline") {
    query_spline(asset.spline(name), asset.origin_m(), query_rows(kPoint, asset, arguments),
                 arguments);
    return kDone;
  }
  const LoadedMesh mesh = asset.mesh(name);
  if (kind == "distance") {
    query_distance(mesh, asset.origin_m(), query_rows(kPoint, asset, arguments), arguments);
  } else {
    query_segment(mesh, query_rows(kSegment, asset, arguments), arguments);
  }
  return kDone;
}

}  // namespace firmtouch::cli
