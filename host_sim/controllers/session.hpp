#pragma once
#include <memory>
#include <string>

#include "firmtouch/controller.hpp"
#include "host_sim/controllers/asset_file.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

/// An asset and the in-process controller that opened it.
struct Session {
  /// Throws Refused naming the file and the rule that refuses it.
  explicit Session(const std::string& asset_path);

  AssetFile asset;
  std::unique_ptr<Controller> controller;
};

/// A path as a log names it: relative to the log's folder where that is possible, so that both can
/// move together.
std::string path_from(const std::string& folder_of, const std::string& path);
/// The other way round.
std::string path_beside(const std::string& file, const std::string& relative);

}  // namespace firmtouch::host_sim
