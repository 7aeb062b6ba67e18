// A shell answers from its own block: the asset may be out of reach.
#include <sys/mman.h>

#include <cstring>

#include "../surface/shapes.hpp"
#include "bake/asset_views.hpp"
#include "bake/asset_writer.hpp"
#include "bumpy_ring.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/hull/complete_cast.hpp"
#include "firmtouch/hull/shell_cast.hpp"
#include "firmtouch/hull/shell_distance.hpp"
#include "surface/make_part.hpp"

namespace firmtouch::tools {
namespace {

/// An asset in pages that can be locked, as flash that nobody may read.
class Flash {
 public:
  explicit Flash(const std::vector<uint8_t>& file) : size_(file.size()) {
    at_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    CHECK(at_ != MAP_FAILED);
    std::memcpy(at_, file.data(), size_);
  }
  Flash(const Flash&) = delete;
  Flash& operator=(const Flash&) = delete;
  ~Flash() { munmap(at_, size_); }
  core::Bytes bytes() const {
    return {static_cast<const uint8_t*>(at_), static_cast<uint32_t>(size_)};
  }
  void lock() { CHECK_EQ(mprotect(at_, size_, PROT_NONE), 0); }
  void unlock() { CHECK_EQ(mprotect(at_, size_, PROT_READ), 0); }

 private:
  void* at_;
  size_t size_;
};

struct Line {
  math::Vec3 a, b;
};
std::vector<Line> lines_about(const Surface& surface, int count) {
  Random random(21);
  float low[3] = {1e9f, 1e9f, 1e9f}, high[3] = {-1e9f, -1e9f, -1e9f};
  for (const math::Vec3& v : surface.vertices) {
    const float at[3] = {v.x, v.y, v.z};
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
  }
  const auto anywhere = [&](float size) {
    float p[3];
    for (int k = 0; k < 3; ++k) {
      const float middle = (low[k] + high[k]) / 2, half = (high[k] - low[k]) / 2;
      p[k] = middle + half * size * static_cast<float>(random.between(-1, 1));
    }
    return math::Vec3{p[0], p[1], p[2]};
  };
  std::vector<Line> lines;
  for (int i = 0; i < count; ++i) {
    math::Vec3 a = anywhere(2);
    a.x = i % 2 == 0 ? low[0] - (high[0] - low[0]) : high[0] + (high[0] - low[0]);
    lines.push_back({a, anywhere(i % 3 == 0 ? 1 : 2)});
  }
  return lines;
}

}  // namespace

TEST(AShellInFastMemoryAnswersWithTheAssetLocked) {
  const BakedHull baked(make_part(1, 3000), 300, 16);
  const AssetFile file = write_asset(baked.sections);
  CHECK(file.problem.empty());
  Flash flash(file.bytes);
  asset::Container container;
  CHECK(asset::open(flash.bytes(), container).ok());
  hull::View view;
  CHECK_EQ(hull::open(hull_sections_of(container, "model"), view).rule, 0);
  const core::Bytes stored = container.find(hull::kShellSection, "model");
  std::vector<uint32_t> fast(stored.size() / 4);
  std::memcpy(fast.data(), stored.data(), stored.size());
  hull::Shell shell;
  CHECK_EQ(
      hull::open_shell({reinterpret_cast<const uint8_t*>(fast.data()), stored.size()}, view, shell)
          .rule,
      0);
  const std::vector<Line> lines = lines_about(baked.surface, 1000);
  std::vector<hull::ShellHit> told;
  flash.lock();  // a read of the asset ends this program
  for (const Line& line : lines) {
    told.push_back(hull::cast_shell(shell, line.a, line.b, query::kUnlimited));
    const hull::ShellDistance distance = hull::shell_distance(shell, line.a, query::kUnlimited);
    CHECK(distance.side == hull::ShellSide::kOutside);
  }
  flash.unlock();
  uint32_t free_lines = 0, hits = 0, ghosts = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    test::note("segment", static_cast<int64_t>(i));
    const mesh::Hit truth = hull::cast_segment(view, lines[i].a, lines[i].b, query::kUnlimited);
    CHECK(told[i].exact);
    if (truth.hit) CHECK(told[i].hit && told[i].t <= truth.t + 0x1p-17f);
    hits += truth.hit ? 1u : 0u;
    free_lines += told[i].hit ? 0u : 1u;
    ghosts += told[i].hit && !truth.hit ? 1u : 0u;
  }
  CHECK_LT(100u, hits);
  CHECK_LT(300u, free_lines);
  CHECK_LT(ghosts * 10, free_lines);
}

TEST(AShellWindsAroundEveryPointOfTheMesh) {
  const BakedHull baked(bumpy_ring(8, 4, 0.2), 200, 16);
  uint32_t inside = 0;
  for (const Face& face : baked.surface.faces) {
    const math::Vec3 p = baked.surface.vertices[face[0]], q = baked.surface.vertices[face[1]];
    const math::Vec3 middle{(p.x + q.x) / 2 * 0.999f, (p.y + q.y) / 2 * 0.999f,
                            (p.z + q.z) / 2 * 0.999f};
    if (winding_by_angles(baked.surface, to_point(middle)) < 0.9) continue;
    ++inside;
    int32_t winding;
    uint32_t steps = 0;
    CHECK(hull::wind_around(baked.view.shell(), middle, query::kUnlimited, winding, steps));
    CHECK_LE(1, winding);
  }
  CHECK_LT(100u, inside);
  int32_t winding = 9;
  uint32_t steps = 0;
  CHECK(hull::wind_around(baked.view.shell(), {0, 0, 0}, query::kUnlimited, winding, steps));
  CHECK_EQ(winding, 0);  // the hole of the ring
}

TEST(AShellWhoseBudgetRunsOutTellsAHitAtOnce) {
  const BakedHull baked(bumpy_ring(8, 4), 200, 16);
  const hull::ShellHit hit = hull::cast_shell(baked.view.shell(), {-3, 0, 0}, {3, 0.1f, 0.2f}, {1});
  CHECK(hit.hit && !hit.exact);
  CHECK_EQ(hit.t, 0.0f);
  int32_t winding;
  uint32_t steps = 0;
  CHECK(!hull::wind_around(baked.view.shell(), {0, 0, 0}, {1}, winding, steps));
}

}  // namespace firmtouch::tools
