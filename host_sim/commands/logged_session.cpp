#include "host_sim/commands/logged_session.hpp"

#include <cstdio>
#include <cstdlib>

#include "firmtouch/params/table.hpp"

namespace firmtouch::host_sim {
namespace {

const std::string& entry(const Log& log, const std::string& path, const std::string& key) {
  const auto found = log.text.find(key);
  if (found == log.text.end())
    throw Refused(path + ": its header has no entry `" + key + "`; record the run again");
  return found->second;
}

void check_same(const std::string& path, const char* what, uint64_t logged, uint64_t here,
                int digits, const char* remedy) {
  if (logged == here) return;
  char text[96];
  std::snprintf(text, sizeof text, ": recorded with %0*llx, here %0*llx; ", digits,
                static_cast<unsigned long long>(logged), digits,
                static_cast<unsigned long long>(here));
  throw Refused(path + ": " + what + text + remedy);
}

}  // namespace

std::string entry_or_empty(const Log& log, const std::string& key) {
  const auto found = log.text.find(key);
  return found == log.text.end() ? "" : found->second;
}

std::unique_ptr<Session> session_of(const std::string& path, const Log& log,
                                    const std::string& asset) {
  check_same(path, "parameter table",
             std::strtoull(entry(log, path, "parameter_table").c_str(), nullptr, 16),
             params::table_hash(), 16, "use the version that recorded it");
  auto session = std::make_unique<Session>(
      asset.empty() ? path_beside(path, entry(log, path, "asset")) : asset,
      SceneNames{entry_or_empty(log, "surface"), entry_or_empty(log, "guide")},
      entry_or_empty(log, "contact") == "penalty" ? Contact::kPenalty : Contact::kProxy);
  check_same(path, ("asset CRC of " + session->asset.path()).c_str(),
             std::strtoull(entry(log, path, "asset_crc").c_str(), nullptr, 16),
             session->controller->asset_crc(), 8, "give the recorded asset with --asset");
  return session;
}

}  // namespace firmtouch::host_sim
