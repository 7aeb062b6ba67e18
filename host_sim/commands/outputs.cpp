#include "host_sim/commands/outputs.hpp"

#include <filesystem>

#include "cli/files.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
  return !error && whole_a == fs::weakly_canonical(fs::absolute(b, error), error) && !error;
}

void check_differ(const NamedFiles::value_type& output, const NamedFiles::value_type& other) {
  if (output.second.empty() || other.second.empty() || other.second == "-") return;
  // An output has a second path while it is written.
  if (!same_file(output.second, other.second) &&
      !same_file(partial_of(output.second), other.second))
    return;
  cli::fail_usage(output.first + " " + output.second + " would overwrite " + other.first + " (" +
                  other.second + "); name another file");
}

}  // namespace

void check_outputs(const NamedFiles& inputs, const NamedFiles& outputs) {
  for (size_t i = 0; i < outputs.size(); ++i) {
    for (const auto& input : inputs) check_differ(outputs[i], input);
    for (size_t k = 0; k < outputs.size(); ++k)
      if (k != i) check_differ(outputs[i], outputs[k]);
  }
  for (const auto& output : outputs) {
    if (output.second.empty()) continue;
    cli::check_output(output.second);
    check_writable(output.second);
  }
}

}  // namespace firmtouch::host_sim
