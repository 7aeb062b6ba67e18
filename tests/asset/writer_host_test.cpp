#include <cstring>

#include "asset/small_file.hpp"
#include "bake/asset/asset_writer.hpp"
#include "bake/asset/probes.hpp"
#include "bake/asset/provenance.hpp"
#include "firmtouch/asset/opening.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using tools::Section;

Section section(uint32_t type, const std::string& name, std::initializer_list<uint8_t> bytes) {
  return {type, name, bytes};
}

core::Bytes span_of(const std::vector<uint8_t>& bytes) {
  return {bytes.data(), static_cast<uint32_t>(bytes.size())};
}

}  // namespace

TEST(Writer_GivesTheBytesWrittenByHand) {
  const asset_test::SmallFile by_hand;
  std::vector<Section> sections = {section(0x1001, "wall", {}), section(0x7777, "bump", {}),
                                   section(0x1001, "bump", {0xA0, 0xA1, 0xA2, 0xA3, 0xA4})};
  for (int i = 0; i < 16; ++i) sections[0].bytes.push_back(static_cast<uint8_t>(255 - i));
  for (int i = 0; i < 32; ++i) sections[1].bytes.push_back(static_cast<uint8_t>(i * 7));
  const tools::AssetFile file = tools::write_asset(sections);
  CHECK_EQ(file.problem.size(), 0u);
  CHECK_EQ(file.bytes.size(), by_hand.size);
  CHECK(file.bytes.size() == by_hand.size &&
        memcmp(file.bytes.data(), by_hand.bytes, by_hand.size) == 0);
}

TEST(Writer_SectionOrder_DoesNotChangeTheFile) {
  const Section a = section(0x1001, "a", {1}), b = section(0x1002, "a", {2}),
                c = section(0x1001, "\xC3\xA4", {3});
  const std::vector<uint8_t> bytes = tools::write_asset({a, b, c}).bytes;
  CHECK(bytes == tools::write_asset({c, b, a}).bytes);
  asset::Container container;
  CHECK(asset::open(span_of(bytes), container).ok());
  CHECK_EQ(container.find(0x1001, "\xC3\xA4")[0], 3);
}

TEST(Writer_InvalidInput_IsRejected) {
  const std::string longest(31, 'n');
  CHECK(tools::write_asset({section(1, longest, {1})}).problem.empty());
  CHECK(!tools::write_asset({section(1, longest + "n", {1})}).problem.empty());
  CHECK(!tools::write_asset({section(1, "", {1})}).problem.empty());
  CHECK(!tools::write_asset({section(1, "a\nb", {1})}).problem.empty());
  CHECK(!tools::write_asset({section(1, "a", {})}).problem.empty());
  CHECK(!tools::write_asset({section(1, "a", {1}), section(1, "a", {2})}).problem.empty());
}

TEST(TextSections_RoundTrip) {
  const tools::Facts facts = {{"source", "my part.obj"}, {"empty", ""}};
  const Section text = tools::text_section(2, "x", facts);
  CHECK(tools::read_facts(text.bytes.data(), text.bytes.size()) == facts);
  const uint8_t cut[] = {'a', ' ', 'b'};
  CHECK(tools::read_facts(cut, sizeof(cut)).empty());
  const uint8_t keyless[] = {'a', '\n'};
  CHECK(tools::read_facts(keyless, sizeof(keyless)).empty());
}

TEST(Provenance_HasSourceAndKnownHash) {
  const std::vector<uint8_t> source = {'a'};
  const tools::Facts facts = tools::provenance("a.obj", source, "", "tool 1");
  CHECK(facts[2] ==
        (tools::Facts::value_type{"source_fnv1a64", "af63dc4c8601ec8c"}));  // as published
}

TEST(ProbePoints_AreDeterministicAndInRange) {
  const float low[3] = {-1, 0, 2}, high[3] = {1, 4, 3};
  const std::vector<math::Vec3> anchors = {{-1, 0, 2}, {1, 4, 3}, {0, 2, 2.5f}};
  const auto points = tools::probe_points(low, high, anchors, 64);
  const auto again = tools::probe_points(low, high, anchors, 64);
  CHECK_EQ(points.size(), 64u);
  CHECK(memcmp(points.data(), again.data(), 64 * sizeof(points[0])) == 0);
  int on_anchor = 0, far = 0;
  for (const query::ProbePoint& p : points) {
    for (const math::Vec3& a : anchors) {
      if (!(p.x_m < a.x || p.x_m > a.x || p.y_m < a.y || p.y_m > a.y || p.z_m < a.z || p.z_m > a.z))
        ++on_anchor;
    }
    if (p.x_m > 5 || p.x_m < -5 || p.y_m > 8 || p.y_m < -4) ++far;
  }
  CHECK_EQ(on_anchor, 8);
  CHECK_GE(far, 4);
}
