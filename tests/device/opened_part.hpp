#pragma once
#include "device/stored_bar.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/device/stored_linkage.hpp"
#include "harness/rules.hpp"

namespace firmtouch::device_test {

/// A section with a part behind all else.
template <class Layout, class Before = device::LinkageLayout>
struct StoredWith {
  Before before;
  Layout part;
};

/// The part of a section, opened; without its part a program rejects the section.
template <class Part, class Section>
struct OpenedPart {
  Section stored;
  device::StoredLinkage linkage;
  Part part;
  core::Verdict verdict;

  explicit OpenedPart(const Section& from) : stored(from) {
    const core::Bytes bytes = test::bytes(&stored, sizeof stored);
    const core::Bytes before = Part::before(bytes);
    CHECK_EQ(before.size(), sizeof stored - sizeof part.layout());
    CHECK_EQ(Part::before(before).size(), before.size());
    CHECK_EQ(open({bytes.data(), sizeof(device::LinkageLayout)}, linkage).rule, 0u);
    device::StoredLinkage none;
    CHECK_EQ(open(bytes, none).rule, uint16_t{device::kRuleLinkageSize});
    verdict = part.open(bytes, linkage);
    CHECK(part.is_open() == verdict.ok());
  }
  OpenedPart(const OpenedPart&) = delete;
};

/// `rule` rejects the part of a section at `element`.
template <class Part, class Section>
void check_broken(const Section& stored, uint16_t rule, uint32_t element) {
  const OpenedPart<Part, Section> opened(stored);
  CHECK_EQ(opened.verdict.rule, rule);
  CHECK_EQ(opened.verdict.element, element);
}

}  // namespace firmtouch::device_test
