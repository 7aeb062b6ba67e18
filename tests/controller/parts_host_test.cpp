// Compositions of a controller: the rules that name a missing part, and the same bits from fewer
// parts.
#include <cstring>
#include <vector>

#include "controller/ride.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/controller/objects_controller.hpp"
#include "firmtouch/device/layout.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/hull/layout.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "firmtouch/scene/materials_layout.hpp"
#include "firmtouch/scene/objects_layout.hpp"
#include "firmtouch/scene/tool_layout.hpp"
#include "firmtouch/spline/guide/view.hpp"
#include "harness/test.hpp"

using namespace firmtouch::controller_test;
using namespace firmtouch;

namespace {

using OnlyMesh = Controller<Surfaces<MeshSurface>>;
using MeshAndGuide = Controller<Surfaces<MeshSurface>, CurveGuide>;
using Trusting =
    Controller<Surfaces<FullMesh>, CurveGuide, CartesianDevice, firmtouch::asset::Trusted>;

constexpr uint32_t kAll = (1u << kPartCount) - 1;

tools::Section spline_head(bool is_surface) {
  spline::Head head{};
  head.is_surface = is_surface ? 1 : 0;
  std::vector<uint8_t> bytes(sizeof head);
  std::memcpy(bytes.data(), &head, sizeof head);
  return {spline::kHeadSection, "x", bytes};
}

core::Verdict missing(const std::vector<tools::Section>& sections, const Selection& selection,
                      uint32_t linked) {
  const Asset asset(file_of(sections));
  asset::Container container;
  CHECK(asset::open(asset.bytes(), container).ok());
  return missing_part(container, selection, linked);
}

template <class C>
record::TickOutput last_of_ride(const Asset& asset) {
  static C controller;
  CHECK_EQ(controller.open(asset.bytes()).rule, 0u);
  Ride ride;
  record::TickOutput output{};
  uint32_t contacts = 0;
  for (uint32_t tick = 0; tick < 1500; ++tick) {
    ride.fill(tick);
    controller.tick(ride.input, output);
    contacts += (output.state & record::kStateContact) != 0 ? 1u : 0u;
  }
  CHECK_GE(contacts, 100u);
  return output;
}

}  // namespace

TEST(Trusted_SameBits_CrcsAndProbesStay_ProofsDoNot) {
  const record::TickOutput proven = last_of_ride<MeshAndGuide>(both());
  const record::TickOutput trusted = last_of_ride<Trusting>(both());
  CHECK(std::memcmp(&proven, &trusted, sizeof proven) == 0);
  static Trusting controller;
  static FullController prover;
  Asset flipped(file_of(part_sections()));
  flipped.begin[flipped.size - 1] ^= 1;
  CHECK(!controller.open(flipped.bytes()).ok());
  const auto bent = [](uint32_t type, size_t at, uint8_t to) {
    std::vector<tools::Section> sections = part_sections();
    for (tools::Section& section : sections)
      if (section.type == type) section.bytes[at % section.bytes.size()] = to;
    return Asset(file_of(std::move(sections)));
  };
  CHECK_EQ(controller.open(bent(mesh::kProbesSection, 8, 0xA5).bytes()).rule,
           uint16_t{firmtouch::kRuleMeshProbes});
  // A fold of -128 breaks a rule; probes see it only where one is nearest to that edge.
  constexpr uint32_t kFolds = 8;
  uint32_t unproven = 0;
  for (uint32_t i = 0; i < kFolds; ++i) {
    const Asset folded = bent(mesh::kEdgeFoldsSection, 997 * i, 0x80);
    CHECK_EQ(prover.open(folded.bytes()).rule, uint16_t{mesh::kRuleFold});
    unproven += controller.open(folded.bytes()).ok() ? 1u : 0u;
  }
  CHECK_GE(unproven, kFolds / 2);
}

TEST(MissingPart_IsNamedByItsRule) {
  const std::vector<std::vector<tools::Section>> needs = {
      {{mesh::kHeadSection, "x", {1}}},
      {{field::kHeadSection, "x", {1}}},
      {{hull::kHeadSection, "x", {1}}},
      {{curve::kHeadSection, "x", {1}}},
      {spline_head(true)},
      {spline_head(false), {spline::kArcsSection, "x", {1, 2, 3, 4}}},
      {{device::kLinkageSection, "x", {1}}},
      {{scene::kObjectsSection, "x", {1}}},
      {{scene::kMaterialsSection, "x", {1}}},
      {{scene::kToolSection, "x", {1}}}};
  for (uint32_t part = 0; part < kPartCount; ++part) {
    CHECK_EQ(missing(needs[part], {}, kAll & ~(1u << part)).rule, kRuleNeedsMesh + part);
    CHECK_EQ(missing(needs[part], {}, 1u << part).rule, 0u);
  }
}

TEST(SplineCurveWithoutLengths_NeedsNoPart) {
  CHECK_EQ(missing({spline_head(false)}, {}, 0).rule, 0u);
}

TEST(SelectedGeometry_OthersDoNotCount) {
  std::vector<tools::Section> sections = {{mesh::kHeadSection, "wanted", {1}}, spline_head(true)};
  CHECK_EQ(missing(sections, {}, kPartMesh).rule, uint16_t{kRuleNeedsSpline});
  CHECK_EQ(missing(sections, {"wanted", nullptr}, kPartMesh).rule, 0u);
}

TEST(MeshController_RejectsAnAssetWithAGuide_AndKeepsTheMotorsOff) {
  static OnlyMesh controller;
  CHECK_EQ(controller.open(both().bytes()).rule, uint16_t{kRuleNeedsGuide});
  CHECK_EQ(faults_when_enabled(controller), servo::kFaultAsset);
}

TEST(MeshController_HasTheSameBitsAsTheFullOne) {
  const Asset part(file_of(part_sections()));
  const record::TickOutput full = last_of_ride<FullController>(part);
  const record::TickOutput mesh = last_of_ride<OnlyMesh>(part);
  CHECK_EQ(std::memcmp(&full, &mesh, sizeof full), 0);
}

TEST(MeshAndGuide_HasTheSameBitsAsTheFullOne) {
  const record::TickOutput full = last_of_ride<FullController>(both());
  const record::TickOutput some = last_of_ride<MeshAndGuide>(both());
  CHECK_EQ(std::memcmp(&full, &some, sizeof full), 0);
}

TEST(Materials_AreProvenBeforeATick_AndNeedTheirPart) {
  static Controller<Surfaces<MaterialMesh>> controller;
  static OnlyMesh without;
  const auto part_of = [](uint8_t number) {
    std::vector<tools::Section> sections = part_sections();
    mesh::View view;
    CHECK(tools::open_baked(sections, "part", view).ok());
    scene::MaterialLayout material = {{'a'}, 500, 0, 0, 0};
    std::vector<uint8_t> triangles(view.head().triangle_count, 1);
    triangles[1234] = number;
    sections.push_back(tools::make_section(scene::kMaterialsSection, "part", &material, 1));
    sections.push_back(tools::make_section(scene::kTriangleMaterialsSection, "part", triangles));
    return file_of(std::move(sections));
  };
  const Asset good(part_of(0)), bad(part_of(2));
  CHECK_EQ(controller.open(good.bytes()).rule, 0u);
  CHECK(controller.surface<MaterialMesh>().materials().is_open());
  CHECK_EQ(without.open(good.bytes()).rule, uint16_t{kRuleNeedsMaterials});
  CHECK_EQ(controller.open(bad.bytes()).rule, uint16_t{scene::kRuleMaterialIndex});
  CHECK_EQ(controller.verdict().element, 1234u);
  CHECK(!controller.surface<MaterialMesh>().materials().is_open());
}

TEST(ObjectsController_WithoutMaterialsHasTheSameBitsAsTheFullOne) {
  const record::TickOutput full = last_of_ride<FullController>(both());
  const record::TickOutput all = last_of_ride<ObjectsController>(both());
  CHECK_EQ(std::memcmp(&full, &all, sizeof full), 0);
}

TEST(PartialTable_HasTheRowsOfItsPartsInTheFullTablesOrder) {
  CHECK_EQ(FullController::kTable.size(), uint32_t{params::kCount});
  CHECK_LE(OnlyMesh::kTable.size(), params::kCount - 15u);
  uint32_t row = 0;
  for (const params::Entry& entry : OnlyMesh::kTable) {
    while (row < params::kCount && params::kTable[row].number != entry.number) ++row;
    CHECK_LE(row + 1, uint32_t{params::kCount});
    CHECK_EQ(std::strcmp(params::kTable[row].name, entry.name), 0);
  }
}
