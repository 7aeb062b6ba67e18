#pragma once
#include <stdint.h>

#include "harness/test.hpp"

namespace firmtouch::test {

/// Opens sections of a sound asset in slices of `units`: the view is closed until the last one.
/// Result: how many slices that took.
template <class Opening, class Sections>
uint32_t slices_of(const Sections& sections, uint32_t units) {
  Opening opening(sections);
  uint32_t slices = 0;
  for (; !opening.done() && slices < 1000; ++slices) {
    CHECK_EQ(opening.view().is_open(), false);
    opening.work(units);
  }
  CHECK_EQ(opening.verdict().ok(), true);
  CHECK_EQ(opening.view().is_open(), true);
  return slices;
}

}  // namespace firmtouch::test
