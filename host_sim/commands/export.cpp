#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/logged_session.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/device/drawn_links.hpp"
#include "host_sim/report/vtk_export.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {
namespace {

namespace fs = std::filesystem;

constexpr double kPictures_Hz = 60;

double parameter_in(const Log& log, const char* name) {
  return std::strtod(entry_or_empty(log, std::string("parameter.") + name).c_str(), nullptr);
}

// A folder that gets its name when all in it is written.
class NewFolder {
 public:
  explicit NewFolder(const std::string& path) : path_(path), partial_(partial_of(path)) {
    std::error_code error;
    if (fs::exists(path_, error) && !(fs::is_directory(path_, error) && fs::is_empty(path_, error)))
      throw Refused(path_ + ": it is there, and not an empty folder; name another one");
    fs::remove_all(partial_, error);
    if (!fs::create_directory(partial_, error))
      throw Refused(path_ + ": cannot be made: " + error.message());
  }
  ~NewFolder() {
    std::error_code error;
    fs::remove_all(partial_, error);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  const std::string& partial() const { return partial_; }
  void finish() {
    std::error_code error;
    fs::rename(partial_, path_, error);
    if (error) throw Refused(path_ + ": cannot be made: " + error.message());
  }

 private:
  std::string path_, partial_;
};

int export_log(const cli::Arguments& options) {
  const std::string path = options.positionals()[0];
  std::string to = options.positionals()[1];
  while (to.size() > 1 && to.back() == '/') to.pop_back();
  const Log log = read_log(path);
  if (log.records.empty()) throw Refused(path + ": it contains no tick: " + log.damage);
  const std::unique_ptr<Session> session = session_of(path, log, options.text("--asset"));
  if (log.decimation != 1 && !session->objects.empty())
    throw Refused(path + ": it lacks ticks in which objects move; record with --decimate 1");
  const Environment environment = environment_of(
      *session->controller, {parameter_in(log, "scene_x_m"), parameter_in(log, "scene_y_m"),
                             parameter_in(log, "scene_z_m")});
  VtkExport what;
  what.period_s = parameter_in(log, "tick_period_s");
  if (!(what.period_s > 0)) throw Refused(path + ": its header has no tick period");
  const double records_Hz = 1 / what.period_s / log.decimation;
  what.every = static_cast<uint32_t>(
      options.number("--every", std::max(1.0, std::round(records_Hz / kPictures_Hz)), 1));
  what.tool_radius_m = static_cast<float>(parameter_in(log, "tool_radius_m"));
  const device::StoredLinkage& linkage = session->controller->linkage();
  if (linkage.is_open()) what.linkage = kinematics_of(linkage);
  NewFolder folder(to);
  const uint32_t ticks =
      export_vtk(log, environment, what, folder.partial(), progress_bar("exporting"));
  folder.finish();
  if (!log.is_complete)
    std::fprintf(stderr, "%s: %s; the %zu ticks before them are exported\n", path.c_str(),
                 log.damage.c_str(), log.records.size());
  std::printf("%s/run.pvd: %u of %zu ticks\n", to.c_str(), ticks, log.records.size());
  return log.is_complete ? 0 : 1;
}

}  // namespace

cli::Command export_command() {
  return {{"export", "LOG FOLDER [options]", 2, 2, export_log},
          "writes the scene and what moved in it over time as VTK files, for ParaView",
          R"(ParaView opens FOLDER/run.pvd. Its files are text: scene_N.vtp has surface and guide,
anew where objects have moved; tick_N.vtp has the tip, the proxy and a line between
them, and a linkage's links. At the tip are force_N and velocity_mps; part is 0 for the
tip, 1 for the proxy, 2 for links; the fields are penetration_m, tool_radius_m, is_on
and faults. The folder is made, whole or not at all. Exit code 1: the log is damaged,
and what is before that is exported.)",
          {{"--every", "N", "every Nth tick of the log (default: 60 in a second)"},
           {"--asset", "FILE", "the asset, if it is not at the path in the log"}}};
}

}  // namespace firmtouch::host_sim
