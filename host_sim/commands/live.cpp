#include <csignal>
#include <cstdio>
#include <iostream>
#include <optional>

#include "firmtouch/link/protocol.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/controllers/asset_remedy.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/device/drawn_links.hpp"
#include "host_sim/live/live_server.hpp"
#include "host_sim/report/linkage_data.hpp"
#include "host_sim/report/page_data.hpp"
#include "host_sim/report/page_parts.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

volatile std::sig_atomic_t g_stop = 0;
void on_signal(int) { g_stop = 1; }

void fill(std::string& page, const std::string& place, const std::string& with) {
  page.replace(page.find(place), place.size(), with);
}

// Rules and their remedies, as a JSON object; 0 stands for all others.
std::string remedies() {
  constexpr uint32_t kRules = 1000;
  tools::Json all;
  for (uint32_t rule = 0; rule < kRules; ++rule)
    if (rule == 0 || asset_remedy(rule) != asset_remedy(0))
      all.add(std::to_string(rule), json_text(asset_remedy(rule)));
  return all.object();
}

// The whole page in one text; `session`: of the part that it shows, or null.
std::string live_page(const Session* session) {
  std::string scene;
  if (session != nullptr) {
    const Environment environment = environment_of(*session->controller, {});
    const double radius_m = static_cast<double>(params::kTable[params::kToolRadius].initial);
    const Scene3d scene3d = surface_scene(environment, radius_m);
    const device::StoredLinkage& stored = session->controller->linkage();
    const std::string linkage = stored.is_open() ? linkage_data_of(kinematics_of(stored)) : "null";
    scene = "<script>window.firmtouchScene = {" + scene_data_of(scene3d, environment) +
            ",\"linkage\":" + linkage + "};</script>\n";
  }
  std::string page = kLiveHtml;
  fill(page, "{{script}}", kLiveJs);
  fill(page, "{{protocol}}", std::to_string(link::kProtocolVersion));
  fill(page, "{{remedies}}", remedies());
  fill(page, "{{scene}}", scene);
  fill(page, "{{style}}", kLiveCss);
  return page;
}

int serve_live(const cli::Arguments& options) {
  const std::string asset = options.text("--asset"), to = options.text("--page");
  std::optional<Session> session;
  if (!asset.empty()) session.emplace(asset);
  if (!to.empty()) {
    check_outputs({{"--asset", asset}}, {{"--page", to}});
    write_file(to, live_page(session ? &*session : nullptr));
    return 0;
  }
  if (options.positionals().empty()) options.refuse("name a controller, or --page FILE.html");
  const std::string where = options.positionals()[0];
  const double port = options.number("--port", 5678, 1);
  if (!(port <= 65535)) options.refuse("--port: a number up to 65535 is needed");
  LiveServer server(static_cast<uint16_t>(port), live_page(session ? &*session : nullptr),
                    connect_stream(where, wait_s(options)));
  std::cerr << "http://127.0.0.1:" << static_cast<int>(port) << "/   (Ctrl-C ends)\n";
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  while (g_stop == 0) server.poll(200);
  return 0;
}

}  // namespace

cli::Command live_command() {
  return {{"live", "CONTROLLER [options]", 0, 1, serve_live},
          "serves a page that shows and tunes a running controller in a browser, until Ctrl-C",
          R"(CONTROLLER: unix:PATH, tcp:HOST:PORT or a serial DEVICE (1 Mbaud).
The page is served to this machine only. One page holds the link; others wait.)",
          {{"--asset", "FILE", "the controller's asset: the page shows its part, and its linkage"},
           {"--port", "N", "of http://127.0.0.1:N/ (default: 5678)"},
           wait_option(),
           {"--page", "FILE.html",
            "write the page instead, for use over WebSerial without this program"}}};
}

}  // namespace firmtouch::host_sim
