// Materials as an asset stores them: each rule broken alone, any byte damaged, and what is read.
#include "firmtouch/scene/stored_materials.hpp"

#include <cmath>
#include <cstring>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/relief.hpp"
#include "harness/rules.hpp"
#include "scene/proxy_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using scene::MaterialLayout;

namespace {

// A plate whose triangles are of materials 0, 1, 2, 0, ...
struct Stored {
  scene_test::ProxyRig rig{scene_test::plate(0.01f)};
  std::vector<MaterialLayout> table;
  std::vector<scene::TextureLayout> textures;
  std::vector<scene::ReliefLayout> reliefs;
  std::vector<uint8_t> triangles, samples;

  explicit Stored(uint32_t count = 2) {
    for (uint32_t i = 0; i < count; ++i) {
      MaterialLayout material = {};
      std::snprintf(material.name, sizeof material.name, "m%u", i);
      material.stiffness_N_per_m = 500.0f * static_cast<float>(i + 1);
      material.friction_static = 0.5f, material.friction_dynamic = 0.25f;
      material.friction_viscous_N_s_per_m = 2;
      table.push_back(material);
      textures.push_back({{{{100, -200, 300}, 2e-4f}, {{1000, 0, 0}, 1e-4f}}});
    }
    for (uint32_t t = 0; t < rig.view.head().triangle_count; ++t)
      triangles.push_back(static_cast<uint8_t>(t % 3));
  }
  // Two maps of 8 and 16 samples a side, on which the waves are lower.
  void add_reliefs() {
    for (uint32_t i = 0; i < table.size(); ++i) {
      textures[i].wave[0].height_m = 0;
      scene::ReliefLayout relief = {{500, 0, 0}, {0, 400, 300}, 1e-4f, 0, 0, 0, 8u << i};
      relief.first = static_cast<uint32_t>(samples.size());
      for (uint32_t k = 0; k < relief.side * relief.side; ++k)
        samples.push_back(static_cast<uint8_t>(k % 3 * 20));
      const scene::ReliefBounds bounds = scene::bounds_of(relief, samples.data());
      relief.slope = bounds.slope, relief.per_m = bounds.per_m;
      reliefs.push_back(relief);
    }
  }
  core::Verdict open(scene::StoredMaterials& to, uint32_t spare_bytes = 0) const {
    std::vector<uint8_t> bytes(table.size() * sizeof(MaterialLayout) + spare_bytes);
    if (!table.empty()) std::memcpy(bytes.data(), table.data(), table.size() * sizeof table[0]);
    held = std::move(bytes);
    return scene::open({{held.data(), static_cast<uint32_t>(held.size())},
                        {triangles.data(), static_cast<uint32_t>(triangles.size())},
                        {reinterpret_cast<const uint8_t*>(textures.data()),
                         static_cast<uint32_t>(textures.size() * sizeof textures[0])},
                        {reinterpret_cast<const uint8_t*>(reliefs.data()),
                         static_cast<uint32_t>(reliefs.size() * sizeof reliefs[0])},
                        {samples.data(), static_cast<uint32_t>(samples.size())}},
                       rig.view, to);
  }
  core::Verdict verdict(uint32_t spare_bytes = 0) const {
    scene::StoredMaterials to;
    const core::Verdict found = open(to, spare_bytes);
    CHECK_EQ(to.is_open(), found.ok());
    return found;
  }
  mutable std::vector<uint8_t> held;
};

template <class Break>
void check_break(uint16_t rule, uint32_t element, const Break& break_it, bool has_reliefs = false) {
  Stored stored;
  if (has_reliefs) stored.add_reliefs();
  test::check_rule(stored, rule, element, break_it);
}

}  // namespace

TEST(StoredMaterials_EachRuleIsBrokenAlone) {
  check_break(scene::kRuleMaterialCount, 0, [](Stored& s) { s.table.clear(); });
  CHECK_EQ(Stored().verdict(1).rule, uint16_t{scene::kRuleMaterialCount});
  CHECK_EQ(Stored(255).verdict().rule, 0u);
  CHECK_EQ(Stored(256).verdict().rule, uint16_t{scene::kRuleMaterialCount});
  check_break(scene::kRuleMaterialName, 1, [](Stored& s) { s.table[1].name[0] = 0; });
  check_break(scene::kRuleMaterialName, 0, [](Stored& s) { s.table[0].name[1] = 7; });
  check_break(scene::kRuleMaterialName, 0, [](Stored& s) { s.table[0].name[31] = 'x'; });
  check_break(scene::kRuleMaterialTwice, 1, [](Stored& s) { s.table[1].name[1] = '0'; });
  const float bad[] = {-1, NAN, INFINITY};
  for (const float value : bad) {
    check_break(scene::kRuleMaterialValue, 1,
                [&](Stored& s) { s.table[1].stiffness_N_per_m = value; });
    check_break(scene::kRuleMaterialValue, 0,
                [&](Stored& s) { s.table[0].friction_static = value; });
    check_break(scene::kRuleMaterialValue, 0,
                [&](Stored& s) { s.table[0].friction_dynamic = value; });
    check_break(scene::kRuleMaterialValue, 0,
                [&](Stored& s) { s.table[0].friction_viscous_N_s_per_m = value; });
  }
  check_break(scene::kRuleMaterialValue, 0, [](Stored& s) { s.table[0].stiffness_N_per_m = 0; });
  check_break(scene::kRuleMaterialValue, 0, [](Stored& s) { s.table[0].friction_static = 101; });
  check_break(scene::kRuleMaterialBytes, 0, [](Stored& s) { s.triangles.pop_back(); });
  check_break(scene::kRuleMaterialBytes, 0, [](Stored& s) { s.triangles.push_back(0); });
  check_break(scene::kRuleMaterialIndex, 11, [](Stored& s) { s.triangles[11] = 3; });
  check_break(scene::kRuleMaterialIndex, 0, [](Stored& s) { s.triangles[0] = 255; });
}

TEST(StoredMaterials_EachRuleOfTexturesIsBrokenAlone) {
  check_break(scene::kRuleTextureCount, 0, [](Stored& s) { s.textures.pop_back(); });
  check_break(scene::kRuleTextureCount, 0, [](Stored& s) { s.textures.push_back({}); });
  const auto check_wave = [](uint16_t rule, scene::WaveLayout wave) {
    for (const size_t which : {size_t{0}, size_t{1}}) {
      Stored stored;
      stored.textures[1].wave[which] = wave;
      CHECK_EQ(stored.verdict().rule, rule);
      CHECK_EQ(stored.verdict().element, rule == 0 ? 0u : 1u);
    }
  };
  check_wave(0, {{0, 0, 1000}, 1e-4f});
  for (const float height_m : {-1e-6f, 0.0021f, NAN, INFINITY})
    check_wave(scene::kRuleTextureValue, {{0, 0, 1}, height_m});
  for (const float per_m : {1.1e5f, -1.1e5f, NAN, INFINITY, -INFINITY})
    check_wave(scene::kRuleTextureValue, {{0, per_m, 0}, 0});
  check_wave(scene::kRuleTextureValue, {{0, 2400, 0}, 1e-4f});  // pi 0.24 alone is steep enough
  check_wave(scene::kRuleTextureValue, {{0, 1e5f, 0}, 0.002f});
  Stored smooth;
  smooth.textures.clear();
  CHECK_EQ(smooth.verdict().rule, 0u);
}

TEST(StoredMaterials_EachRuleOfReliefsIsBrokenAlone) {
  const auto check = [](uint16_t rule, uint32_t element, const auto& break_it) {
    check_break(rule, element, break_it, true);
  };
  check(scene::kRuleTextureCount, 0, [](Stored& s) { s.reliefs.pop_back(); });
  check(scene::kRuleTextureCount, 0, [](Stored& s) { s.reliefs.push_back({}); });
  for (const float bad : {-1e-6f, 0.0021f, NAN, INFINITY}) {
    check(scene::kRuleTextureValue, 1, [&](Stored& s) { s.reliefs[1].height_m = bad; });
    if (!(bad > 0 && bad < 1))
      check(scene::kRuleTextureValue, 1, [&](Stored& s) { s.reliefs[1].slope = bad; });
  }
  check(scene::kRuleTextureValue, 0, [](Stored& s) { s.reliefs[0].slope = 0.75f; });  // and waves
  check(scene::kRuleTextureValue, 0, [](Stored& s) { s.reliefs[0].per_m = INFINITY; });
  for (const float bad : {1.1e5f, NAN, -INFINITY}) {
    check(scene::kRuleTextureValue, 1, [&](Stored& s) { s.reliefs[1].u_per_m[2] = bad; });
    check(scene::kRuleTextureValue, 1, [&](Stored& s) { s.reliefs[1].v_per_m[0] = bad; });
  }
  for (const uint32_t side : {0u, 2u, 3u, 24u, 32u, 128u, 1u << 16, UINT32_MAX})
    check(scene::kRuleReliefSamples, 1, [&](Stored& s) { s.reliefs[1].side = side; });
  for (const uint32_t first : {65u, 320u, 321u, UINT32_MAX})
    check(scene::kRuleReliefSamples, 1, [&](Stored& s) { s.reliefs[1].first = first; });
  check(scene::kRuleReliefSamples, 1, [](Stored& s) { s.samples.pop_back(); });
  check(scene::kRuleReliefBounds, 1, [](Stored& s) { s.reliefs[1].slope *= 0.999f; });
  check(scene::kRuleReliefBounds, 1, [](Stored& s) { s.reliefs[1].per_m *= 0.999f; });
  check(scene::kRuleReliefBounds, 0, [](Stored& s) { s.samples[63] = 255; });
  check(0, 0, [](Stored& s) { s.textures.clear(); });  // maps alone
  check(0, 0, [](Stored& s) { s.reliefs[0] = {}; });   // of one material
}

// What passes is no deeper and no steeper than it may be, whatever was damaged.
TEST(StoredMaterials_AnyByteOfAReliefDamaged_IsRefusedOrBounded) {
  Stored stored;
  stored.add_reliefs();
  auto* bytes = reinterpret_cast<uint8_t*>(stored.reliefs.data());
  uint32_t refused = 0;
  for (uint32_t i = 0; i < 2 * sizeof(scene::ReliefLayout) + stored.samples.size(); ++i)
    for (uint32_t flip = 1; flip < 256; flip += 2) {
      uint8_t& byte = i < 88 ? bytes[i] : stored.samples[i - 88];
      byte ^= static_cast<uint8_t>(flip);
      scene::StoredMaterials materials;
      if (!stored.open(materials).ok()) ++refused;
      for (int k = 0; k < 20; ++k) {
        const float at_m = 1.7e-4f * static_cast<float>(k);
        const scene::Cut cut =
            materials.cut_of(1u + static_cast<uint32_t>(k % 2), {at_m, -at_m, 0.1f});
        CHECK(cut.depth_m >= 0 && cut.depth_m <= scene::kMaxTextureHeight_m * 1.0001f);
        CHECK_LE(math::length(cut.slope), scene::kMaxTextureSlope * 1.0001f);
      }
      byte ^= static_cast<uint8_t>(flip);
    }
  CHECK_GE(refused, 10000u);
}

TEST(StoredMaterials_ReadsWhatIsStored) {
  const Stored stored;
  scene::StoredMaterials materials;
  CHECK_EQ(materials.of(0), 0u);  // nothing is open
  CHECK(stored.open(materials).ok());
  CHECK_EQ(materials.table().size(), 2u);
  for (uint32_t t = 0; t < stored.triangles.size(); ++t) CHECK_EQ(materials.of(t), t % 3);
  CHECK_EQ(materials.table()[1].stiffness_N_per_m, 1000.0f);
}

// What passes is in range, whatever was damaged.
TEST(StoredMaterials_AnyByteDamaged_IsRefusedOrInRange) {
  Stored stored;
  auto* bytes = reinterpret_cast<uint8_t*>(stored.table.data());
  uint32_t refused = 0;
  for (uint32_t i = 0; i < 2 * sizeof(MaterialLayout); ++i)
    for (const uint8_t flip : {uint8_t{1}, uint8_t{0x40}, uint8_t{0x80}, uint8_t{0xFF}}) {
      bytes[i] ^= flip;
      if (!stored.verdict().ok()) ++refused;
      for (const MaterialLayout& material : stored.table) {
        if (!stored.verdict().ok()) break;
        CHECK(material.stiffness_N_per_m > 0 && std::isfinite(material.stiffness_N_per_m));
        CHECK(material.friction_static >= 0 && material.friction_static <= 100);
        CHECK(material.friction_dynamic >= 0 && material.friction_dynamic <= 100);
        CHECK(material.friction_viscous_N_s_per_m >= 0 &&
              material.friction_viscous_N_s_per_m <= 1000);
      }
      bytes[i] ^= flip;
    }
  CHECK_GE(refused, 100u);
}

// The same of textures: what passes is no deeper and no steeper than they may be.
TEST(StoredMaterials_AnyByteOfATextureDamaged_IsRefusedOrBounded) {
  Stored stored;
  auto* bytes = reinterpret_cast<uint8_t*>(stored.textures.data());
  uint32_t refused = 0;
  for (uint32_t i = 0; i < 2 * sizeof(scene::TextureLayout); ++i)
    for (uint32_t flip = 1; flip < 256; ++flip) {
      bytes[i] ^= static_cast<uint8_t>(flip);
      const bool passes = stored.verdict().ok();
      if (!passes) ++refused;
      for (int k = 0; passes && k < 20; ++k) {
        const float at_m = 1.7e-4f * static_cast<float>(k);
        const scene::Cut cut = scene::cut_at(stored.textures[i / 32], {at_m, -at_m, 0.1f});
        CHECK(cut.depth_m >= 0 && cut.depth_m <= scene::kMaxTextureHeight_m * 1.0001f);
        CHECK_LE(math::length(cut.slope), scene::kMaxTextureSlope * 1.0001f);
      }
      bytes[i] ^= static_cast<uint8_t>(flip);
    }
  CHECK_GE(refused, 1000u);
}
