#include "host_sim/device/device_file.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <vector>

#include "firmtouch/device/rules.hpp"
#include "host_sim/scenario/line_reader.hpp"

namespace firmtouch::host_sim {
namespace {

struct Key {
  std::string name;
  const char* unit;
  double low, high;
  bool must_be_given;
  std::function<void(double)> set;
};

struct Word {
  const char *name, *value;
  std::function<void()> set;
};

struct Keys {
  std::vector<Key> keys;
  std::vector<Word> words;  // a key whose value is one of several words

  void number(const std::string& name, const char* unit, double low, double high, float& value,
              bool must_be_given = true) {
    keys.push_back({name, unit, low, high, must_be_given,
                    [&value](double si) { value = static_cast<float>(si); }});
  }
  void length(const std::string& name, float& value_m) { number(name, "m", 1e-3, 10, value_m); }
  void offset(const std::string& name, float& value_m) {
    number(name, "m", -10, 10, value_m, false);
  }
  void flag(const char* name, const char* yes, const char* no, bool& value) {
    words.push_back({name, yes, [&value] { value = true; }});
    words.push_back({name, no, [&value] { value = false; }});
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

Keys keys_of(LinkageDevice& device) {
  Keys to;
  std::visit([&](auto& linkage) { add_keys(linkage, to); }, device.linkage);
  for (int k = 0; k < static_cast<int>(device.joints.joints); ++k) {
    device::JointSetting& joint = device.joints.joint[k];
    to.number(of("counts", k), "counts/rad", -1e7, 1e7, joint.counts_per_rad);
    to.number(of("zero", k), "rad", -100, 100, joint.zero_rad, false);
    to.number(of("low", k), "rad", -100, 100, joint.low_rad);
    to.number(of("high", k), "rad", -100, 100, joint.high_rad);
    to.number(of("max_torque", k), "N*m", 0, 1000, device.limits.max_torque_Nm[k]);
  }
  to.number("max_speed", "rad/s", 0, 1e4, device.joints.max_speed_rad_per_s, false);
  to.number("full_from", "", 0, 1, device.limits.full_from, false);
  to.number("gone_at", "", 0, 1, device.limits.gone_at, false);
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
    arm.joints =
        static_cast<uint32_t>(std::lround(words.more() ? words.quantity("joints", "", 2, 3) : 3));
    device.linkage = arm;
    device.joints.joints = arm.joints;
  } else if (kind == "delta") {
    device.linkage = device::Delta{};
  } else {
    words.refuse("`" + kind + "` is no linkage; write five_bar, serial_arm or delta");
  }
}

std::string names(const Keys& keys) {
  std::string list;
  for (const Key& key : keys.keys) list += (list.empty() ? "" : ", ") + key.name;
  for (const Word& word : keys.words)
    if (list.find(word.name) == std::string::npos) list += std::string(", ") + word.name;
  return list;
}

void set(Keys& keys, const std::string& name, LineReader& words) {
  for (const Key& key : keys.keys)
    if (key.name == name) return key.set(words.quantity(name, key.unit, key.low, key.high));
  std::string choices;
  for (const Word& word : keys.words)
    if (word.name == name) choices += (choices.empty() ? "" : " or ") + std::string(word.value);
  if (choices.empty()) words.refuse("unknown key `" + name + "`; known are " + names(keys));
  const std::string value = words.next(choices);
  for (const Word& word : keys.words)
    if (word.name == name && word.value == value) return word.set();
  words.refuse("`" + name + "` is " + choices + ", not `" + value + "`");
}

void check_rules(const std::string& name, const LinkageDevice& device) {
  const core::Verdict verdicts[] = {
      std::visit([](const auto& linkage) { return device::check(linkage); }, device.linkage),
      device::check(device.joints), device::check(device.limits)};
  for (const core::Verdict verdict : verdicts)
    if (!verdict.ok())
      throw Refused(name + ": " + device::rule_name(verdict.rule) + " (element " +
                    std::to_string(verdict.element) + ")");
}

}  // namespace

LinkageDevice read_device(const std::string& name, const std::string& text) {
  LinkageDevice device;
  Keys keys;
  const std::vector<std::string> no_names;
  std::map<std::string, int> given;  // and the line
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    LineReader words(line, name + ":" + std::to_string(number), no_names, false);
    if (words.empty()) continue;
    if (keys.keys.empty()) {
      set_linkage(device, words);
      keys = keys_of(device);
    } else {
      const std::string key = words.next("a key");
      const auto first = given.emplace(key, number);
      if (!first.second)
        words.refuse("`" + key + "` is given twice, first in line " +
                     std::to_string(first.first->second));
      set(keys, key, words);
    }
    words.end();
  }
  if (keys.keys.empty()) throw Refused(name + ": it has no line; begin with `linkage five_bar`");
  for (const Key& key : keys.keys)
    if (key.must_be_given && given.count(key.name) == 0)
      throw Refused(name + ": `" + key.name + "` is missing");
  check_rules(name, device);
  return device;
}

}  // namespace firmtouch::host_sim
