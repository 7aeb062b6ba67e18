#include "simd/levels.hpp"

namespace firmtouch_simd {

#if defined(__x86_64__)
extern const Searches kX86V2, kX86V3, kX86V4;
#elif defined(__aarch64__)
extern const Searches kNeon;
#endif

namespace {

std::vector<Level> found_levels() {
  std::vector<Level> found{{"scalar", nullptr}};
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("sse4.2") || !__builtin_cpu_supports("popcnt")) return found;
  found.push_back({"x86-64-v2", &kX86V2});
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("bmi2") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("fma"))
    return found;
  found.push_back({"x86-64-v3", &kX86V3});
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    found.push_back({"x86-64-v4", &kX86V4});
#elif defined(__aarch64__)
  found.push_back({"neon", &kNeon});
#endif
  return found;
}

const Level* g_level = nullptr;

}  // namespace

const std::vector<Level>& levels() {
  static const std::vector<Level> found = found_levels();
  return found;
}

const Level& level() {
  if (g_level != nullptr) return *g_level;
  const Level& best = levels().back();
  // With four floats at once v2 is slower than scalar at random points: spot 1.59 us against 1.47,
  // bracket 1.03 against 0.83 (November 2026).
  return std::string(best.name) == "x86-64-v2" ? levels().front() : best;
}

std::string use_level(const std::string& name) {
  std::string names;
  for (const Level& each : levels()) {
    if (name == each.name) {
      g_level = &each;
      return {};
    }
    names += names.empty() ? each.name : std::string(", ") + each.name;
  }
  return "--isa " + name + ": this processor has " + names;
}

}  // namespace firmtouch_simd
