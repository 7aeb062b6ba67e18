#pragma once
#include <memory>
#include <string>

#include "host_sim/controllers/session.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {

/// An entry of the log's header; empty if it has none.
std::string entry_or_empty(const Log& log, const std::string& key);

/// The asset that the log `path` was recorded with, opened with the same surface, guide and
/// contact. `asset`: its path; empty: as the log names it. Throws Refused if it is another one, or
/// the log is of another parameter table.
std::unique_ptr<Session> session_of(const std::string& path, const Log& log,
                                    const std::string& asset);

}  // namespace firmtouch::host_sim
