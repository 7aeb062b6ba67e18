#include "device/device_file.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <vector>

#include "device/device_rules.hpp"
#include "device/line_reader.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

struct Key {
  std::string name;
  const char* unit;
  double low, high;
  bool must_be_given;
  double initial;  // in SI; NaN: none
  std::function<void(double)> set;
  std::string instead = {};  // the key that may stand for it
};

struct Word {
  const char *name, *value;
  bool is_initial;
  std::function<void()> set;
};

struct Keys {
  std::vector<Key> keys;
  std::vector<Word> words;  // a key whose value is one of several words

  template <class T>
  void number(const std::string& name, const char* unit, double low, double high, T& value,
              bool must_be_given = true) {
    keys.push_back({name, unit, low, high, must_be_given, static_cast<double>(value),
                    [&value](double si) { value = static_cast<T>(si); }});
  }
  void rod(const std::string& link, const std::string& end, Rod& rod) {
    rod.centre_m = rod.inertia_kg_m2 = kNotGiven;
    number(link + "_mass" + end, "kg", 0, 100, rod.mass_kg, false);
    number(link + "_centre" + end, "m", -10, 10, rod.centre_m, false);
    number(link + "_inertia" + end, "kg*m2", 0, 100, rod.inertia_kg_m2, false);
  }
  // Given together with others.
  void part(const std::string& name, const char* unit, double high, float& value) {
    number(name, unit, 0, high, value, false);
    keys.back().initial = kNotGiven;
  }
  void length(const std::string& name, float& value_m) { number(name, "m", 1e-3, 10, value_m); }
  void offset(const std::string& name, float& value_m) {
    number(name, "m", -10, 10, value_m, false);
  }
  void flag(const char* name, const char* yes, const char* no, bool& value) {
    words.push_back({name, yes, value, [&value] { value = true; }});
    words.push_back({name, no, !value, [&value] { value = false; }});
  }
};

std::string of(const char* name, int k) { return std::string(name) + "_" + std::to_string(k); }

void add_keys(device::FiveBar& bar, Keys& to) {
  to.offset("base", bar.base_m);
  for (int k = 0; k < 2; ++k) {
    to.length(of("proximal", k), bar.proximal_m[k]);
    to.length(of("distal", k), bar.distal_m[k]);
  }
  to.flag("tip", "left", "right", bar.is_tip_left);
}

void add_keys(device::SerialArm& arm, Keys& to) {
  for (int k = 0; k < 2; ++k) to.length(of("link", k), arm.link_m[k]);
  to.offset("offset", arm.offset_m);
  to.offset("height", arm.height_m);
  to.flag("elbow", "parallelogram", "relative", arm.has_parallelogram);
}

void add_keys(device::Delta& delta, Keys& to) {
  for (int k = 0; k < 3; ++k) {
    to.length(of("upper", k), delta.upper_m[k]);
    to.length(of("lower", k), delta.lower_m[k]);
  }
  to.offset("base_radius", delta.base_radius_m);
  to.offset("platform_radius", delta.platform_radius_m);
  to.offset("side", delta.side_m);
  to.flag("tip", "above", "below", delta.is_tip_above);
}

void add_second_encoders(LinkageDevice& device, Keys& to) {
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k)
    to.keys.push_back(
        {of("second", k), "counts/rad", -1e4, 1e4, false, kNotGiven, [&device, k](double si) {
           device.second_counts_per_rad[k] = static_cast<float>(si);
           device.has_second_encoders = true;
         }});
  to.part("second_within", "rad", 100, device.second_within_rad);
}

void add_index_pulses(LinkageDevice& device, Keys& to) {
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k) {
    to.keys.push_back({of("index", k), "rad", -100, 100, false, kNotGiven, [&device, k](double si) {
                         device.homing.index_rad[k] = static_cast<float>(si);
                         device.has_index_pulses = true;
                       }});
    to.part(of("index_period", k), "rad", 100, device.homing.index_period_rad[k]);
  }
  to.part("index_within", "rad", 100, device.homing.index_within_rad);
}

void add_derating(LinkageDevice& device, Keys& to) {
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k) {
    to.keys.push_back(
        {of("continuous_torque", k), "N*m", 0, 1000, false, kNotGiven, [&device, k](double si) {
           device.continuous_Nm[k] = static_cast<float>(si);
           device.is_derated = true;
         }});
    to.keys.push_back(
        {of("continuous_current", k), "A", 0, 1e4, false, kNotGiven, [&device, k](double si) {
           device.continuous_A[k] = static_cast<float>(si);
           device.is_derated = true;
         }});
    to.part(of("thermal_time", k), "s", 1e4, device.thermal_time_s[k]);
  }
}

// Its angle must be given: gravity says where it has to be.
void add_springs(LinkageDevice& device, Keys& to) {
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k) {
    JointFriction& joint = device.masses.joint[k];
    to.number(of("spring", k), "N*m/rad", 0, 1000, joint.spring_N_m_per_rad, false);
    to.number(of("relaxed", k), "rad", -100, 100, joint.relaxed_rad, false);
    to.keys.back().initial = kNotGiven;
  }
}

void add_homing(LinkageDevice& device, Keys& to) {
  for (const char* by : {"stops", "pose"})
    to.words.push_back({"home", by, false, [&device, by] {
                          device.is_homed = true;
                          device.homing.by = by == std::string("stops")
                                                 ? device::HomeBy::kStops
                                                 : device::HomeBy::kKnownPose;
                        }});
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k) {
    to.part(of("home_torque", k), "N*m", 1000, device.homing.torque_Nm[k]);
    to.number(of("home_pose", k), "rad", -100, 100, device.homing.pose_rad[k], false);
  }
  to.number("home_speed", "rad/s", 0, 1e4, device.homing.speed_rad_per_s, false);
  to.number("home_margin", "rad", 0, 100, device.homing.margin_rad, false);
}

// What this kind of linkage has.
Keys own_keys(LinkageDevice& device) {
  Keys to;
  std::visit([&](auto& linkage) { add_keys(linkage, to); }, device.linkage);
  const std::vector<Link> links = links_of(device);
  for (size_t i = 0; i < links.size(); ++i)
    to.rod(links[i].name, "_" + std::to_string(links[i].number), device.masses.rod[i]);
  return to;
}

void add_masses(LinkageDevice& device, Keys& to) {
  MassModel& masses = device.masses;
  to.number("tip_mass", "kg", 0, 100, masses.tip_mass_kg, false);
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k) {
    JointFriction& joint = masses.joint[k];
    to.number(of("rotor", k), "kg*m2", 0, 100, joint.rotor_kg_m2, false);
    to.number(of("cable", k), "N*m/rad", 0, 1e5, joint.cable_N_m_per_rad, false);
    to.number(of("cable_damping", k), "N*m*s/rad", 0, 100, joint.cable_N_m_s, false);
    to.number(of("backlash", k), "rad", 0, 1, joint.backlash_rad, false);
    to.number(of("viscous", k), "N*m*s/rad", 0, 100, joint.viscous_N_m_s, false);
    to.number(of("coulomb", k), "N*m", 0, 100, joint.coulomb_N_m, false);
    to.number(of("breakaway", k), "N*m", 0, 100, joint.breakaway_N_m, false);
    to.number(of("stribeck_speed", k), "rad/s", 0, 1000, joint.stribeck_rad_per_s, false);
    to.number(of("amplifier_lag", k), "s", 0, 0.1, joint.lag_s, false);
    to.number(of("ripple", k), "", 0, 1, joint.ripple, false);
    to.number(of("cogging", k), "N*m", 0, 100, joint.cogging_N_m, false);
    to.number(of("poles", k), "", 0, 10000, joint.poles, false);
    to.number(of("encoder_noise", k), "", 0, 1000, joint.noise_counts, false);
    to.number(of("winding_rise", k), "K", 1, 300, joint.winding_rise_K, false);
    to.number(of("magnet_rise", k), "K", 0, 300, joint.magnet_rise_K, false);
    to.number(of("magnet_time", k), "s", 0.1, 1e5, joint.magnet_time_s, false);
  }
  to.number("gravity_x", "m/s2", -100, 100, masses.gravity_mps2.x, false);
  to.number("gravity_y", "m/s2", -100, 100, masses.gravity_mps2.y, false);
  to.number("gravity_z", "m/s2", -100, 100, masses.gravity_mps2.z, false);
  to.number("stop_stiffness", "N*m/rad", 0.01, 1e5, masses.stop_N_m_per_rad, false);
  to.number("stop_damping", "N*m*s/rad", 0, 100, masses.stop_N_m_s, false);
}

// What every linkage has.
void add_common(LinkageDevice& device, Keys& to) {
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k) {
    device::JointSetting& joint = device.joints.joint[k];
    to.number(of("counts", k), "counts/rad", -1e7, 1e7, joint.counts_per_rad);
    to.number(of("zero", k), "rad", -100, 100, joint.zero_rad, false);
    to.number(of("low", k), "rad", -100, 100, joint.low_rad);
    to.number(of("high", k), "rad", -100, 100, joint.high_rad);
    to.number(of("max_torque", k), "N*m", 0, 1000, device.limits.max_torque_Nm[k]);
    to.keys.back().instead = of("max_current", k);
    to.part(of("max_current", k), "A", 1e4, device.max_A[k]);
    to.part(of("torque_constant", k), "N*m/A", 1e4, device.Nm_per_A[k]);
  }
  to.number("max_speed", "rad/s", 0, 1e4, device.joints.max_speed_rad_per_s, false);
  to.number("full_from", "", 0, 1, device.limits.full_from, false);
  to.number("gone_at", "", 0, 1, device.limits.gone_at, false);
  to.number("torque_rise", "s", 1e-4, 1, device.torque_rise_s, false);
  to.number("carried_share", "", 0, 0.9, device.carried_share, false);
  to.number("friction_share", "", 0, 0.8, device.friction_share, false);
  to.number("friction_fade", "rad/s", 1e-3, 100, device.friction_fade_rad_per_s, false);
  add_homing(device, to);
  add_index_pulses(device, to);
  add_second_encoders(device, to);
  add_derating(device, to);
  add_springs(device, to);
  to.flag("walls", "forced", "stable", device.are_walls_forced);
  add_masses(device, to);
}

Keys keys_of(LinkageDevice& device) {
  Keys to = own_keys(device);
  add_common(device, to);
  return to;
}

void set_linkage(LinkageDevice& device, LineReader& words) {
  words.expect("linkage");
  const std::string kind = words.next("five_bar, serial_arm or delta");
  if (kind == "five_bar") {
    device.linkage = device::FiveBar{};
    device.joints.joints = 2;
  } else if (kind == "serial_arm") {
    device::SerialArm arm;
    const std::string joints = words.more() ? words.next("2 or 3") : "3";
    if (joints != "2" && joints != "3")
      words.refuse("a serial arm has 2 or 3 joints, not `" + joints + "`");
    arm.joints = joints == "2" ? 2 : 3;
    device.linkage = arm;
    device.joints.joints = arm.joints;
  } else if (kind == "delta") {
    device.linkage = device::Delta{};
  } else {
    words.refuse("`" + kind + "` is no linkage; write five_bar, serial_arm or delta");
  }
}

std::vector<std::string> names_of(const Keys& keys) {
  std::vector<std::string> names;
  for (const Key& key : keys.keys) names.push_back(key.name);
  for (const Word& word : keys.words) names.emplace_back(word.name);
  return names;
}

// A joint or a link that this linkage does not have, or a key that none has.
void refuse_unknown(const Keys& keys, const std::string& name, const LineReader& words) {
  const std::string stem = name.substr(0, name.size() - std::min<size_t>(name.size(), 1));
  std::string last;
  for (const Key& key : keys.keys)
    if (key.name.size() == name.size() && key.name.compare(0, stem.size(), stem) == 0 &&
        !stem.empty() && stem.back() == '_')
      last = key.name;
  if (!last.empty())
    words.refuse("this linkage has no `" + name + "`; it has `" + stem + "0` to `" + last + "`");
  words.refuse_unknown("key", name, "firmtouch-sim device --help");
}

void set(Keys& keys, const std::string& name, LineReader& words) {
  for (const Key& key : keys.keys)
    if (key.name == name) return key.set(words.quantity(name, key.unit, key.low, key.high));
  std::string choices;
  for (const Word& word : keys.words)
    if (word.name == name) choices += (choices.empty() ? "" : " or ") + std::string(word.value);
  if (choices.empty()) refuse_unknown(keys, name, words);
  const std::string value = words.next(choices);
  for (const Word& word : keys.words)
    if (word.name == name && word.value == value) return word.set();
  words.refuse("`" + name + "` is " + choices + ", not `" + value + "`");
}

// What is not given of a rod is that of an even one.
void fill_rods(LinkageDevice& device) {
  const std::vector<Link> links = links_of(device);
  for (size_t i = 0; i < links.size(); ++i) {
    Rod& rod = device.masses.rod[i];
    if (std::isnan(rod.centre_m)) rod.centre_m = links[i].length_m / 2;
    if (std::isnan(rod.inertia_kg_m2))
      rod.inertia_kg_m2 = rod.mass_kg * links[i].length_m * links[i].length_m / 12;
  }
}

}  // namespace

LinkageDevice read_device(const std::string& name, const std::string& text) {
  LinkageDevice device;
  Keys keys;
  std::vector<std::string> known;  // once the linkage is
  GivenKeys given;
  read_lines(
      name, text,
      [&](LineReader& words, int number) {
        const std::string key = keys.keys.empty() ? "linkage" : words.next("a key");
        const auto first = given.emplace(key, number);
        if (!first.second)
          words.refuse("`" + key + "` is given twice, first in line " +
                       std::to_string(first.first->second));
        if (keys.keys.empty()) {
          set_linkage(device, words);
          keys = keys_of(device);
          known = names_of(keys);
        } else {
          set(keys, key, words);
        }
        words.end();
      },
      known);
  if (keys.keys.empty()) throw Refused(name + ": it has no line; begin with `linkage five_bar`");
  for (const Key& key : keys.keys)
    if (key.must_be_given && given.count(key.name) == 0 && given.count(key.instead) == 0)
      throw Refused(name + ": `" + key.name + "` is missing; add a line `" + key.name + " VALUE " +
                    key.unit + "`");
  fill_rods(device);
  complete_and_check(name, given, device);
  return device;
}

namespace {

// Words of a list, at most 100 columns a line.
class KeyList {
 public:
  void add(const std::string& word) {
    if (line_.size() + word.size() + 2 > 100) text_ += line_ + ",\n", line_.clear();
    line_ += (line_.empty() ? "    " : ", ") + word;
  }
  std::string text() const { return text_ + line_ + "\n"; }

 private:
  std::string text_, line_;
};

bool is_of_a_further_one(const std::string& name) {
  const size_t end = name.size() - 1;
  return name[end - 1] == '_' && (name[end] == '1' || name[end] == '2');
}

// `counts_0 counts/rad *`, `gone_at (0.05)`, `tip left|right (left)`.
std::string described(const Keys& keys) {
  KeyList list;
  for (const Key& key : keys.keys) {
    if (is_of_a_further_one(key.name)) continue;
    std::ostringstream text;
    text << key.name << (*key.unit != 0 ? " " : "") << key.unit;
    if (key.must_be_given)
      text << " *";
    else if (!std::isnan(key.initial))
      text << " (" << static_cast<float>(key.initial) << ")";
    list.add(text.str());
  }
  for (size_t i = 0; i + 1 < keys.words.size(); i += 2) {  // of each two values
    const Word &one = keys.words[i], &other = keys.words[i + 1];
    const std::string initial = one.is_initial ? one.value : other.is_initial ? other.value : "";
    list.add(std::string(one.name) + " " + one.value + "|" + other.value +
             (initial.empty() ? "" : " (" + initial + ")"));
  }
  return list.text();
}

}  // namespace

std::string device_file_help() {
  std::string text;
  LinkageDevice device;
  for (const char* kind : {"five_bar", "serial_arm 3", "delta"}) {
    device = {};
    LineReader words(std::string("linkage ") + kind, "", {}, false);
    set_linkage(device, words);
    text += std::string("  linkage ") + kind + "\n" + described(own_keys(device));
  }
  Keys common;
  add_common(device, common);
  return text + "  every linkage\n" + described(common);
}

}  // namespace firmtouch::tools
