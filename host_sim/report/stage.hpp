#pragma once
#include <string>

#include "host_sim/report/scene3d.hpp"

namespace firmtouch::host_sim {

/// A page up to the beginning of <main>, with the report's style sheet. `title` is HTML.
std::string page_head(const std::string& title);

/// The card of the 3D view (pages/view3d.js), with its legend and a picture for browsers without
/// JavaScript. `more`: HTML behind the legend.
std::string stage_of(const Scene3d& scene3d, const std::string& title,
                     const std::string& more = "");

}  // namespace firmtouch::host_sim
