#include "device/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "device/symmetric.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kStep = 1e-4;  // of the differences, scaled
constexpr double kLength_m = 0.1;
constexpr uint32_t kMaxRounds = 60;
constexpr double kMaxMisfit = 3;  // rms of the residuals over the noise
// A start that leads to a worse minimum is replaced by others about it, scaled.
constexpr uint32_t kMaxStarts = 30;
constexpr double kSpread = 0.04;

struct Place {
  std::string name;
  const char* unit;
  float* value;
  double scale;
};

std::vector<Place> places_of(LinkageDevice& device, bool with_counts) {
  std::vector<Place> all;
  const auto length = [&](const std::string& name, float& value) {
    all.push_back({name, "m", &value, kLength_m});
  };
  const auto each = [&](const char* name, float* values, int count) {
    for (int k = 0; k < count; ++k) length(std::string(name) + "_" + std::to_string(k), values[k]);
  };
  if (auto* bar = std::get_if<device::FiveBar>(&device.linkage)) {
    each("proximal", bar->proximal_m, 2);
    each("distal", bar->distal_m, 2);
    length("base", bar->base_m);
  } else if (auto* arm = std::get_if<device::SerialArm>(&device.linkage)) {
    each("link", arm->link_m, 2);
    if (arm->joints == 3) length("offset", arm->offset_m), length("height", arm->height_m);
  } else if (auto* delta = std::get_if<device::Delta>(&device.linkage)) {
    each("upper", delta->upper_m, 3);
    each("lower", delta->lower_m, 3);
    length("base_radius", delta->base_radius_m);
    length("platform_radius", delta->platform_radius_m);
    length("side", delta->side_m);
  }
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    device::JointSetting& joint = device.joints.joint[k];
    all.push_back({"zero_" + std::to_string(k), "rad", &joint.zero_rad, 1});
    if (with_counts)
      all.push_back({"counts_" + std::to_string(k), "counts/rad", &joint.counts_per_rad,
                     std::fabs(wide(joint.counts_per_rad))});
  }
  return all;
}

// Result: false where the links do not meet.
bool residuals(const LinkageDevice& device, const std::vector<Touch>& touches,
               std::vector<double>& to) {
  to.clear();
  for (const Touch& touch : touches) {
    const MovingPoints points = points_at(device, touch);
    if (!points.is_closed) return false;
    const Point off = points.tip.at_m - touch.at_m;
    const double normal2 = dot(touch.normal, touch.normal);
    if (touch.radius_m > 0) {
      to.push_back(length(off) - touch.radius_m);
    } else if (normal2 > 0) {
      to.push_back(dot(off, touch.normal) / std::sqrt(normal2));
    } else {
      to.push_back(off.x), to.push_back(off.y);
      if (device.joints.joints == 3) to.push_back(off.z);
    }
  }
  return true;
}

double squares(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

// J^T J and J^T r.
bool normal_equations(const LinkageDevice& device, const std::vector<Touch>& touches,
                      bool with_counts, const std::vector<double>& now, Matrix& square,
                      std::vector<double>& right) {
  const Matrix columns = sensitivity(device, touches, with_counts);
  if (columns.empty()) return false;
  const size_t n = columns.size();
  square.assign(n, std::vector<double>(n));
  right.assign(n, 0);
  for (size_t i = 0; i < n; ++i) {
    for (size_t k = 0; k < now.size(); ++k) right[i] -= columns[i][k] * now[k];
    for (size_t j = 0; j < n; ++j)
      for (size_t k = 0; k < now.size(); ++k) square[i][j] += columns[i][k] * columns[j][k];
  }
  return true;
}

// Moves the parameters by the step of the determined directions.
void move(const std::vector<Place>& places, const Directions& directions, double least,
          double damping, const std::vector<double>& right) {
  const size_t n = places.size();
  std::vector<double> change(n);
  for (size_t d = 0; d < n; ++d) {
    if (directions.value[d] < least) continue;
    double along = 0;
    for (size_t i = 0; i < n; ++i) along += directions.way[d][i] * right[i];
    along /= directions.value[d] + damping;
    for (size_t i = 0; i < n; ++i) change[i] += directions.way[d][i] * along;
  }
  for (size_t i = 0; i < n; ++i)
    *places[i].value = static_cast<float>(wide(*places[i].value) + change[i] * places[i].scale);
}

void describe(const std::vector<Place>& places, double least, Calibration& to) {
  for (const double value : to.directions.value) to.determined += value >= least ? 1 : 0;
  for (size_t i = 0; i < places.size(); ++i) {
    double variance = 0, open = 0;
    for (size_t d = 0; d < places.size(); ++d) {
      const double part = to.directions.way[d][i] * to.directions.way[d][i];
      (d < to.determined ? variance : open) +=
          d < to.determined ? part / to.directions.value[d] : part;
    }
    Calibrated& parameter = to.parameters[i];
    parameter.value = wide(*places[i].value);
    parameter.deviation = to.noise_m * std::sqrt(variance) * places[i].scale;
    parameter.is_determined = open <= 0.01;
    to.scale.push_back(places[i].scale);
  }
}

Calibration calibrate_from(const LinkageDevice& start, const std::vector<Touch>& touches,
                           double noise_m, bool with_counts) {
  Calibration result;
  result.device = start;
  result.noise_m = noise_m;
  const std::vector<Place> places = places_of(result.device, with_counts);
  for (const Place& place : places) result.parameters.push_back({place.name, place.unit});
  const double least = noise_m * noise_m / (kMaxDeviation * kMaxDeviation);
  std::vector<double> now, then, right;
  Matrix square;
  if (touches.empty() || !residuals(result.device, touches, now)) return result;
  double damping = 0;
  for (uint32_t round = 0; round < kMaxRounds && !result.has_converged; ++round) {
    if (!normal_equations(result.device, touches, with_counts, now, square, right)) return result;
    const Directions directions = directions_of(square);
    const std::vector<double> from = parameters_of(result.device, with_counts);
    move(places, directions, least, damping, right);
    const bool is_closed = residuals(result.device, touches, then);
    const double before = squares(now), after = is_closed ? squares(then) : 2 * before + 1;
    result.has_converged = is_closed && std::fabs(after - before) <= 1e-6 * before + 1e-20;
    if (after <= before) {
      now = then;
      damping *= 0.1;
      continue;
    }
    for (size_t i = 0; i < places.size(); ++i) *places[i].value = static_cast<float>(from[i]);
    damping = std::max(10 * damping, 1e-3 * directions.value[0]);
  }
  result.equations = static_cast<uint32_t>(now.size());
  result.rms_m = std::sqrt(squares(now) / static_cast<double>(now.size()));
  result.has_converged &= normal_equations(result.device, touches, with_counts, now, square, right);
  if (!result.has_converged) return result;
  result.directions = directions_of(square);
  describe(places, least, result);
  return result;
}

}  // namespace

MovingPoints points_at(const LinkageDevice& device, const Touch& touch) {
  JointMotion at;
  for (uint32_t k = 0; k < device.joints.joints; ++k)
    at.angle_rad[k] = wide(device.joints.joint[k].zero_rad) +
                      touch.counts[k] / wide(device.joints.joint[k].counts_per_rad);
  return points_of(device, at);
}

// Between floats, whose distance is exact.
Matrix sensitivity(LinkageDevice device, const std::vector<Touch>& touches, bool with_counts) {
  Matrix columns;
  std::vector<double> back;
  for (const Place& place : places_of(device, with_counts)) {
    const float middle = *place.value;
    const auto step = static_cast<float>(kStep * place.scale);
    const float high = middle + step, low = middle - step;
    std::vector<double> column;
    *place.value = high;
    if (!residuals(device, touches, column)) return {};
    *place.value = low;
    if (!residuals(device, touches, back)) return {};
    *place.value = middle;
    const double per = place.scale / (wide(high) - wide(low));
    for (size_t k = 0; k < back.size(); ++k) column[k] = (column[k] - back[k]) * per;
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<double> parameters_of(const LinkageDevice& device, bool with_counts) {
  LinkageDevice copy = device;
  std::vector<double> values;
  for (const Place& place : places_of(copy, with_counts)) values.push_back(wide(*place.value));
  return values;
}

Calibration calibrate(const LinkageDevice& nominal, const std::vector<Touch>& touches,
                      double noise_m, bool with_counts) {
  Calibration best = calibrate_from(nominal, touches, noise_m, with_counts);
  std::mt19937 engine(1);
  const auto fits = [&](const Calibration& it) {
    return it.has_converged && it.rms_m <= kMaxMisfit * noise_m;
  };
  for (uint32_t again = 0; again < kMaxStarts && !fits(best); ++again) {
    LinkageDevice start = nominal;
    for (const Place& place : places_of(start, with_counts)) {
      const double share = static_cast<double>(engine()) / 4294967296.0;
      *place.value += static_cast<float>(kSpread * (2 * share - 1) * place.scale);
    }
    const Calibration other = calibrate_from(start, touches, noise_m, with_counts);
    if (other.has_converged && (!best.has_converged || other.rms_m < best.rms_m)) best = other;
  }
  best.has_converged = fits(best);
  const std::vector<double> before = parameters_of(nominal, with_counts);
  for (size_t i = 0; i < before.size(); ++i) best.parameters[i].before = before[i];
  return best;
}

double deviations2(const Calibration& calibration, const std::vector<double>& truth) {
  double sum = 0;
  for (uint32_t d = 0; d < calibration.determined; ++d) {
    double along = 0;
    for (size_t i = 0; i < truth.size(); ++i)
      along += calibration.directions.way[d][i] * (calibration.parameters[i].value - truth[i]) /
               calibration.scale[i];
    sum += along * along * calibration.directions.value[d];
  }
  return sum / (calibration.noise_m * calibration.noise_m);
}

double chi2_95(uint32_t degrees) {
  const double n = degrees, part = 2 / (9 * n);
  const double root = 1 - part + 1.6448536269514722 * std::sqrt(part);
  return n * root * root * root;
}

}  // namespace firmtouch::tools
