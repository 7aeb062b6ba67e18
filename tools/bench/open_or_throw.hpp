#pragma once
#include <string>
#include <vector>

#include "bake/asset/asset_views.hpp"
#include "bake/asset/section.hpp"
#include "bench/problem.hpp"

namespace firmtouch::bench {

/// Opens what was baked in memory. Throws a Problem if its proof fails: "`what` breaks rule R".
template <class View>
void open_or_throw(const std::vector<tools::Section>& sections, const std::string& name,
                   const std::string& what, View& view) {
  const core::Verdict verdict = tools::open_baked(sections, name, view);
  if (!verdict.ok()) throw Problem(what + " breaks " + tools::rule_text(verdict));
}

}  // namespace firmtouch::bench
