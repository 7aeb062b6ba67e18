#include "shapes.hpp"
#include "surface/check/check.hpp"
#include "surface/crossings.hpp"
#include "surface/read/read_surface.hpp"

// Real models, where FIRMTOUCH_MODELS names their folder.

namespace firmtouch::tools {
namespace {

Surface load(const std::string& folder, const char* name) {
  Imported read = read_surface(folder + "/" + name, 1);
  if (!read.problem.empty()) std::printf("  %s\n", read.problem.c_str());
  CHECK(read.problem.empty());
  return std::move(read.surface);
}

}  // namespace

TEST(SoundModelsPassUntouched) {
  const char* folder = models_folder();
  if (folder == nullptr) return;
  const struct {
    const char* name;
    size_t faces;
  } kModels[] = {{"spot.obj", 5856}, {"rocker-arm.off", 20088}, {"fandisk.obj", 12946}};
  for (const auto& model : kModels) {
    Surface surface = load(folder, model.name);
    CHECK_EQ(surface.faces.size(), model.faces);
    const Surface before = surface;
    const CheckReport report = check_and_mend(surface, {});
    CHECK(report.usable() && report.is_closed && report.mended.empty() && same(surface, before));
    CHECK_LT(0, volume_of(surface));
    CHECK(find_crossings(surface).pairs.empty());
  }
}

TEST(TheHorseIsTurnedAndItsCrossingsListed) {
  const char* folder = models_folder();
  if (folder == nullptr) return;
  Surface horse = load(folder, "horse.ply");
  CHECK_LT(volume_of(horse), 0);
  const CheckReport report = check_and_mend(horse, {});
  CHECK(report.usable() && report.is_closed);
  CHECK(report.mended.size() == 1 &&
        says(report.mended, "turned 1 piece of 96966 faces wound inside out"));
  CHECK_LT(0, volume_of(horse));
  const Crossings found = find_crossings(horse);
  CHECK_EQ(found.pairs.size(), 4u);
  CHECK_EQ(found.places.size(), 1u);
  if (found.places.empty()) return;
  // Seen by brute force: points around whose nearest feature is one of these have a pseudonormal
  // and a winding number that differ.
  CHECK(found.places[0].vertices == (std::vector<uint32_t>{11778, 11890, 11891}));
  CHECK(found.places[0].faces == (std::vector<uint32_t>{70644, 70670, 70686, 71143, 71145, 71399}));
  for (const auto& edge : {std::pair<uint32_t, uint32_t>{11778, 11890},
                           {11778, 11891},
                           {11890, 11891},
                           {11890, 11994}}) {
    CHECK_EQ(std::count(found.places[0].edges.begin(), found.places[0].edges.end(), edge), 1);
  }
}

TEST(ModelsThatAreNoSolidsAreRefusedUnlessUnsigned) {
  const char* folder = models_folder();
  if (folder == nullptr) return;
  const struct {
    const char *name, *what, *where;
  } kModels[] = {{"cow.obj", "1 vertex where separate sheets touch",
                  "vertex 253 (-3.50769, 1.70021, 0 m) of 2 sheets"},
                 {"suzanne.obj", "44 open edges around 5 holes", "edge from vertex 4"},
                 {"stanford-bunny.obj", "223 open edges around 5 holes",
                  "vertex 1884 (-0.0575, 0.058827, 0.02126 m)"}};
  for (const auto& model : kModels) {
    Surface strict = load(folder, model.name), loose = strict;
    const CheckReport report = check_and_mend(strict, {}), kept = check_and_mend(loose, {true});
    CHECK(says(report.refused, model.what) && says(report.refused, model.where));
    CHECK(says(report.refused, "--unsigned"));
    CHECK(kept.usable() && !kept.is_closed && says(kept.kept, model.what));
  }
  Surface bunny = load(folder, "stanford-bunny.obj");
  CHECK(says(check_and_mend(bunny, {true}).mended, "dropped 1113 vertices that no face uses"));
  CHECK_EQ(bunny.vertices.size(), 35947u - 1113u);
}

}  // namespace firmtouch::tools
