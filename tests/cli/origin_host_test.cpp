// Parts far from 0 are baked from an origin of their own: their certificates hold for the decimals
// of the file. Oracle: brute force in double on those.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "bake/asset/origin.hpp"
#include "bench/models.hpp"
#include "cli/baked_asset.hpp"
#include "cli/failure.hpp"
#include "firmtouch/asset/loader.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/view.hpp"
#include "harness/test.hpp"
#include "surface/closest_by_force.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;
using tools::Point;

struct Box {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  Point side() const { return high - low; }
};

Box box_of(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

// So many diagonals away, by whole millimetres.
tools::CadPart far_part(uint64_t seed, double diagonals) {
  tools::CadPart part = tools::make_cad(seed);
  const double away_mm = diagonals * tools::length(box_of(part.vertices_mm).side());
  const Point shift_mm{std::round(0.7 * away_mm), std::round(-0.6 * away_mm),
                       std::round(0.4 * away_mm)};
  for (Point& p : part.vertices_mm) p = p + shift_mm;
  return part;
}

cli::BakedAsset baked(const std::vector<std::string>& paths) {
  cli::BakeRequest request;
  request.inputs = paths;
  request.options.model.frame = tools::FileFrame(0.001);
  request.options.is_quiet = true;
  return cli::bake_asset(request, "part.fta");
}

bool is_refused(const std::vector<std::string>& paths, const char* text) {
  try {
    (void)baked(paths);
    return false;
  } catch (const cli::Failure& failure) {
    return failure.message.find(text) != std::string::npos;
  }
}

asset::Container opened(const cli::BakedAsset& baked) {
  asset::Container container;
  CHECK(
      asset::open({baked.bytes.data(), static_cast<uint32_t>(baked.bytes.size())}, container).ok());
  return container;
}

double distance_by_force(const tools::CadPart& part, Point p_m) {
  double least = 1e300;
  for (const tools::Face& f : part.faces) {
    const Point a = part.vertices_mm[f[0]] * 1e-3, b = part.vertices_mm[f[1]] * 1e-3,
                c = part.vertices_mm[f[2]] * 1e-3;
    least = std::min(least, tools::length(tools::closest_of(p_m, a, b, c) - p_m));
  }
  return least;
}

void check_far_part(uint64_t seed, double diagonals) {
  const bench::TemporaryFolder folder;
  const tools::CadPart part = far_part(seed, diagonals);
  const cli::BakedAsset asset = baked({folder.write("part.obj", tools::to_obj(part))});
  const asset::Container container = opened(asset);
  const Point origin_m = tools::to_point(container.origin_m());
  CHECK(tools::is_moved(origin_m));
  mesh::View view;
  CHECK(asset::open_geometry(container, "part", view).ok());
  const Box box = box_of(part.vertices_mm);
  const double diagonal_m = tools::length(box.side()) * 1e-3;
  tools::Random random(seed);
  for (int i = 0; i < 400; ++i) {
    const auto within = [&](double low, double high) {
      return (low + (random.uniform() * 1.5 - 0.25) * (high - low)) * 1e-3;
    };
    const Point p_m{within(box.low.x, box.high.x), within(box.low.y, box.high.y),
                    within(box.low.z, box.high.z)};
    mesh::Hint hint;
    const mesh::Closest found =
        mesh::closest_point(view, tools::to_vec3(p_m - origin_m), query::kUnlimited, hint);
    const double truth_m = distance_by_force(part, p_m), bar_m = 4e-7 * diagonal_m;
    test::note("point", i);
    CHECK(found.certificate.exact);
    CHECK_LE(std::fabs(std::fabs(static_cast<double>(found.distance_m)) - truth_m), bar_m);
    CHECK_LE(static_cast<double>(found.certificate.lower_m), truth_m + 6e-8 * diagonal_m);
    const Point c_m = tools::in_file(tools::to_point(found.point_m), origin_m);
    CHECK_LE(distance_by_force(part, c_m), bar_m);
  }
}

}  // namespace

TEST(FarParts_AnswersAreThoseOfTheFilesDecimals) {
  for (const double diagonals : {5.0, 30.0, 300.0})
    for (uint64_t seed = 1; seed <= 3; ++seed) check_far_part(seed, diagonals);
}

TEST(NearParts_HaveNoOrigin) {
  const bench::TemporaryFolder folder;
  for (const double diagonals : {0.0, 1.0}) {
    const cli::BakedAsset asset =
        baked({folder.write("part.obj", tools::to_obj(far_part(2, diagonals)))});
    CHECK_EQ(opened(asset).next_of_type(asset::kOriginSection), asset::kNoSection);
  }
}

TEST(AnOrigin_IsAFloatNearTheMiddle_AndZeroWhereFloatsHoldTheBox) {
  tools::Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const double size_m = std::pow(10.0, random.uniform() * 9 - 5),
                 away_m = size_m * std::pow(10.0, random.uniform() * 5 - 1);
    const Point low{away_m * (random.uniform() - 0.5), away_m * (random.uniform() - 0.5), away_m};
    const Point side{size_m * random.uniform(), size_m, size_m * random.uniform()};
    const Point high = low + side, origin_m = tools::origin_for(low, high);
    if (!tools::is_moved(origin_m)) continue;
    const Point off = (low + high) * 0.5 - origin_m;
    const double bar_m = tools::length(side) / 16;
    for (const double x : {off.x, off.y, off.z}) CHECK_LE(std::fabs(x), bar_m);
    for (const double x : {origin_m.x, origin_m.y, origin_m.z})
      CHECK(!(std::fabs(static_cast<double>(static_cast<float>(x)) - x) > 0));
    CHECK(!tools::is_moved(tools::origin_for(low - origin_m, high - origin_m)));
  }
  CHECK(!tools::is_moved(tools::origin_for({1, 1, 1}, {1, 1, 1})));
  CHECK(!tools::is_moved(tools::origin_for({1e300, 0, 0}, {1e300, 1, 1})));
  CHECK(!tools::is_moved(tools::origin_for({INFINITY, 0, 0}, {-INFINITY, 0, 0})));
}

// A curve and a part of one scene: what touches in the file touches in the asset.
TEST(AllInputs_ShareTheOrigin_AndAnAssetKeepsIts) {
  const bench::TemporaryFolder folder;
  const tools::CadPart part = far_part(1, 30);
  const Point a = part.vertices_mm[0], b = part.vertices_mm[1];
  char text[200];
  std::snprintf(text, sizeof text, "x,y,z\n%.17g,%.17g,%.17g\n%.17g,%.17g,%.17g\n", a.x, a.y, a.z,
                b.x, b.y, b.z);
  const std::string model = folder.write("part.obj", tools::to_obj(part)),
                    line = folder.write("line.csv", text);
  const cli::BakedAsset together = baked({model, line}), alone = baked({model});
  const Point origin_m = tools::to_point(opened(together).origin_m());
  const core::Bytes samples = opened(together).find(curve::kSamplesSection, "line");
  const auto* const first = reinterpret_cast<const float*>(samples.data());
  CHECK_LE(std::fabs(static_cast<double>(first[0]) + origin_m.x - a.x * 1e-3), 1e-8);
  // Baked before: nothing of it is moved, so the others follow.
  const std::string path =
      folder.write("part.fta", std::string(alone.bytes.begin(), alone.bytes.end()));
  const std::string near_line = folder.write("near.csv", "x,y,z\n0,0,0\n100,0,0\n");
  const cli::BakedAsset with_near = baked({path, near_line});
  CHECK(!tools::is_moved(tools::to_point(opened(with_near).origin_m()) -
                         tools::to_point(opened(alone).origin_m())));
  const cli::BakedAsset other = baked({folder.write("other.obj", tools::to_obj(far_part(2, 30)))});
  const std::string second =
      folder.write("other.fta", std::string(other.bytes.begin(), other.bytes.end()));
  CHECK(is_refused({path, second}, "another origin"));
  const std::string turned =
      folder.write("turned.objects", "object a of part turned 9 deg about 0 0 1\n");
  CHECK(is_refused({path, turned}, "bake the model instead"));
}

// A turned object turns about the file's origin, so its asset has no other.
TEST(TurnedObjects_KeepTheFilesOrigin) {
  const bench::TemporaryFolder folder;
  const std::string model = folder.write("part.obj", tools::to_obj(far_part(1, 30)));
  const auto has_origin = [&](const char* object) {
    const std::string objects = folder.write("scene.objects", object);
    return tools::is_moved(tools::to_point(opened(baked({model, objects})).origin_m()));
  };
  CHECK(has_origin("object a of part at 5 0 0 mm moves 1 0 0 mm/s\n"));
  CHECK(!has_origin("object a of part turned 90 deg about 0 0 1\n"));
  CHECK(!has_origin("object a of part turned 0.001 deg about 0 0 1\n"));
  CHECK(!has_origin("object a of part turns 0 0 1 rad/s\n"));
}
