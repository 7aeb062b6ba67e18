#include "host_sim/controllers/session.hpp"

#include <filesystem>

namespace firmtouch::host_sim {
namespace {

std::string remedy_of(uint16_t rule) {
  switch (rule) {
    case kRuleEmptyScene:
      return "it holds neither a surface nor a curve; bake one into it";
    case kRuleArithmetic:
      return "this machine's floating-point mode differs from what the library needs";
    case kRuleMeshProbes:
    case kRuleCurveProbes:
    case kRuleSplineProbes:
    case kRuleHullProbes:
      return "this program answers its probe queries with other bits; bake it with the same "
             "version";
    default:
      return "it is damaged or of another version; bake it again";
  }
}

}  // namespace

Session::Session(const std::string& asset_path)
    : asset(asset_path), controller(std::make_unique<FullController>()) {
  const core::Verdict verdict = controller->open(asset.bytes());
  if (verdict.ok()) return;
  throw Refused(asset_path + ": refused by rule R" + std::to_string(verdict.rule) + " at element " +
                std::to_string(verdict.element) + ": " + remedy_of(verdict.rule));
}

std::string path_from(const std::string& folder_of, const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(folder_of, error).parent_path();
  const std::filesystem::path relative = std::filesystem::relative(path, folder, error);
  return error || relative.empty() ? path : relative.string();
}

std::string path_beside(const std::string& file, const std::string& relative) {
  const std::filesystem::path path = relative;
  return path.is_absolute() ? relative
                            : (std::filesystem::path(file).parent_path() / path).string();
}

}  // namespace firmtouch::host_sim
