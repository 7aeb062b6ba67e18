#include <cmath>
#include <cstdio>
#include <sstream>

#include "cli/commands.hpp"
#include "cli/csv_table.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "device/calibration_plan.hpp"
#include "device/calibration_study.hpp"
#include "device/machines.hpp"
#include "json/json.hpp"

namespace firmtouch::cli {
namespace {

using tools::Calibrated;
using tools::Calibration;
using tools::LinkageDevice;

constexpr double kGoal_m = 50e-6;

std::vector<tools::Touch> touches_of(const std::string& path, uint32_t joints) {
  std::vector<std::string> columns;
  for (uint32_t k = 0; k < joints; ++k) columns.push_back("count_" + std::to_string(k));
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "radius"}) columns.emplace_back(name);
  const std::vector<uint8_t> bytes = read_model(path);
  const CsvTable table = read_csv(std::string(bytes.begin(), bytes.end()), path, columns);
  std::vector<tools::Touch> touches;
  for (size_t i = 0; i < table.rows(); ++i) {
    double value[device::kMaxJoints + 7];
    for (size_t c = 0; c < columns.size(); ++c) {
      value[c] = static_cast<double>(table.row(i)[c]);
      if (!std::isfinite(value[c]))
        fail_input(path + ":" + std::to_string(table.line_of[i]) + ": " + columns[c] +
                   " is not finite; leave out this touch");
    }
    const double* place = value + joints;
    tools::Touch touch;
    for (uint32_t k = 0; k < joints; ++k) touch.counts[k] = value[k];
    touch.at_m = {place[0], place[1], place[2]};
    touch.normal = {place[3], place[4], place[5]};
    touch.radius_m = place[6];
    if (touch.radius_m < 0 || (touch.radius_m > 0 && dot(touch.normal, touch.normal) > 0))
      fail_input(path + ":" + std::to_string(table.line_of[i]) +
                 ": a touch has a normal (plate) or a radius above 0 (ball), not both");
    touches.push_back(touch);
  }
  return touches;
}

void print_plan(const LinkageDevice& device, uint32_t count) {
  for (uint32_t k = 0; k < device.joints.joints; ++k) std::printf("count_%u,", k);
  std::printf("x,y,z,nx,ny,nz,radius\n");
  for (const tools::Touch& touch :
       tools::plan_touches(device, count, tools::StudySettings().noise_m)) {
    for (uint32_t k = 0; k < device.joints.joints; ++k) std::printf("%.0f,", touch.counts[k]);
    const tools::Point at = touch.at_m, normal = touch.normal;
    std::printf("%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%g\n", at.x, at.y, at.z, normal.x, normal.y,
                normal.z, touch.radius_m);
  }
}

// The device file with other values of these parameters.
std::string changed(const std::string& text, const Calibration& calibration) {
  std::istringstream lines(text);
  std::string all, line;
  std::vector<bool> is_written(calibration.parameters.size());
  const auto statement = [](const Calibrated& parameter) {
    char words[100];
    std::snprintf(words, sizeof words, "%s %.9g %s", parameter.name.c_str(), parameter.value,
                  parameter.unit);
    return std::string(words) + "  # calibrated\n";
  };
  while (std::getline(lines, line)) {
    std::string key;
    std::istringstream(line) >> key;
    bool is_ours = false;
    for (size_t i = 0; i < is_written.size() && !is_ours; ++i) {
      is_ours = calibration.parameters[i].name == key;
      if (is_ours) all += statement(calibration.parameters[i]), is_written[i] = true;
    }
    if (!is_ours) all += line + "\n";
  }
  for (size_t i = 0; i < is_written.size(); ++i)
    if (!is_written[i]) all += statement(calibration.parameters[i]);
  return all;
}

int print_study(const LinkageDevice& device, const Arguments& arguments) {
  tools::StudySettings settings;
  settings.runs = arguments.count("--runs", settings.runs, 1, 1000000);
  settings.touches = arguments.count("--touches", settings.touches, 1, 100000);
  settings.noise_m = arguments.number("--noise", settings.noise_m, 1e-9);
  const tools::CalibrationStudy study = study_calibration(device, settings);
  const double share = static_cast<double>(study.in_ellipsoid) / study.runs;
  const bool is_met = share >= 0.93 && share <= 0.97 && study.worst_m <= kGoal_m;
  const int code = is_met ? kDone : kAnswerIsNo;
  if (arguments.has("--json")) {
    tools::Json all;
    all.add("runs", uint64_t{study.runs}).add("converged", uint64_t{study.converged});
    all.add("before_m", study.before_m).add("median_m", study.median_m);
    all.add("worst_m", study.worst_m).add("least_rms_m", study.bound_m);
    all.add("in_ellipsoid", share).add("is_met", is_met);
    std::printf("%s\n", all.object().c_str());
    return code;
  }
  std::printf("runs, %u touches, links up to %.0f %% off     %u, converged %u\n", settings.touches,
              100 * settings.links_off, study.runs, study.converged);
  std::printf("largest error over the workspace, before   median %.3g um\n", study.before_m * 1e6);
  std::printf("least rms error at the worst pose          %.3g um (touches anywhere: %.3g)\n",
              study.bound_m * 1e6, study.scattered_bound_m * 1e6);
  std::printf("largest error over the workspace, after    median %.3g, worst %.3g um (goal 50)\n",
              study.median_m * 1e6, study.worst_m * 1e6);
  std::printf("truth in the 95 %% ellipsoid                %.1f %% (goal 93 to 97)\n", 100 * share);
  return code;
}

std::string calibration_json(const Calibration& found) {
  tools::Json all;
  all.add("equations", uint64_t{found.equations}).add("rms_m", found.rms_m);
  all.add("parameters", tools::json_list(found.parameters, [](const Calibrated& parameter) {
            tools::Json row;
            row.add("name", tools::json_text(parameter.name)).add("before", parameter.before);
            row.add("value", parameter.value);
            row.add("deviation", parameter.is_determined ? parameter.deviation : HUGE_VAL);
            return row.add("unit", tools::json_text(parameter.unit)).object();
          }));
  return all.object() + "\n";
}

void print(const Calibration& found) {
  std::printf("%-18s %12s %12s %12s  %s\n", "parameter", "before", "value", "deviation", "unit");
  std::string open;
  for (const Calibrated& parameter : found.parameters) {
    if (!parameter.is_determined) open += (open.empty() ? "" : ", ") + parameter.name;
    std::printf("%-18s %12.8g %12.8g ", parameter.name.c_str(), parameter.before, parameter.value);
    if (parameter.is_determined) std::printf("%12.3g  %s\n", parameter.deviation, parameter.unit);
    if (!parameter.is_determined) std::printf("%12s  %s\n", "open", parameter.unit);
  }
  std::printf("equations %u, residuals %.3g um\n", found.equations, found.rms_m * 1e6);
  if (!open.empty())
    std::printf("the touches do not determine, alone or together: %s\n", open.c_str());
}

}  // namespace

Command calibrate_command() {
  return {
      {"calibrate", "DEVICE TOUCHES.csv [-o FILE] | DEVICE --plan N | DEVICE --study", 1, 2,
       run_calibrate},
      "Finds a linkage's lengths, offsets and zero angles from touches of known things.",
      R"(DEVICE: a device file or a machine's name (firmtouch-sim device). TOUCHES: a header
count_0,count_1[,count_2],x,y,z,nx,ny,nz,radius, then a touch a line: encoder counts, and
in metres in the linkage's frame a point (normal and radius 0), a plate through x y z with
its normal, or a ball with its radius. Least squares with deviations; parameters that the
touches cannot determine are named and stay. Exit code 1: the touches are not fitted to
three times the noise. --plan prints which touches determine the parameters best, as
such a file: touch something near each, and write its known place. Plan half of them,
calibrate, and plan the others with the file found. --study: simulated
touches of a plan, how often the deviations are true, and Cramer and Rao's bound of the
error; exit code 1 beyond 50 um, or with the truth not in 93 to 97 % of the ellipsoids.)",
      {{"-o", "FILE", "the device file with the values found"},
       {"--noise", "METRES", "standard deviation of a touch (default 0.00002)"},
       {"--counts", nullptr, "counts per rad too"},
       {"--plan", "N", "print the touches to make"},
       {"--study", nullptr, "calibrate a simulated machine again and again"},
       {"--runs", "N", "of the study (default 1000)"},
       {"--touches", "N", "of each run of the study (default 40)"},
       {"--json", nullptr, "what was found, for programs; a deviation of null: not determined"}}};
}

int run_calibrate(const Arguments& arguments) {
  const std::string path = arguments.positionals()[0];
  const std::string text = tools::read_device_text(path);
  const LinkageDevice device = tools::read_device(path, text);
  const bool is_study = arguments.has("--study"), is_plan = arguments.has("--plan");
  if ((is_study || is_plan) != (arguments.positionals().size() == 1) || (is_study && is_plan))
    fail_usage("calibrate: give a file of touches, or one of --study and --plan without one");
  if ((is_plan || is_study) && arguments.has("-o"))
    fail_usage("calibrate: -o is for what touches find; --plan and --study print to stdout");
  if (is_plan || is_study)
    for (const tools::JointMotion& at : tools::grid_poses(device))
      if (!tools::points_of(device, at).is_closed)
        fail_input(path + ": there are poses that the links do not reach; narrow low_ and high_");
  if (is_plan) return print_plan(device, arguments.count("--plan", 0, 1, 100000)), kDone;
  if (is_study) return print_study(device, arguments);
  const std::string touches = arguments.positionals()[1], output = arguments.text("-o", "");
  if (!output.empty()) forbid_overwriting(output, touches);
  const Calibration found = calibrate(
      device, touches_of(touches, device.joints.joints),
      arguments.number("--noise", tools::StudySettings().noise_m, 1e-9), arguments.has("--counts"));
  if (found.parameters.empty() || !found.has_converged) {
    std::fprintf(stderr,
                 "%s: the touches do not fit the linkage: residuals of %.3g um; check counts, "
                 "units, frame and assembly branch\n",
                 touches.c_str(), found.rms_m * 1e6);
    return kAnswerIsNo;
  }
  if (arguments.has("--json")) std::fputs(calibration_json(found).c_str(), stdout);
  if (!arguments.has("--json")) print(found);
  if (output.empty()) return kDone;
  const std::string file = changed(text, found);
  (void)tools::read_device(output, file);  // what is written can be read
  write_file(output, file.data(), file.size());
  return kDone;
}

}  // namespace firmtouch::cli
