#pragma once
#include <string>
#include <vector>

namespace firmtouch::tools {

/// Device files of known machines, by name. Each value has its source in the file; a line that ends
/// with `# assumed` has none, and no figure that depends on it is that machine's.
std::vector<std::string> machine_names();

/// The text of a machine's device file; empty for an unknown name.
std::string machine_text(const std::string& name);

/// Keys of a device file whose lines end with `# assumed`.
std::vector<std::string> assumed_keys(const std::string& text);

/// Text of the device `name`: a machine, or else a file. Throws Refused if it cannot be read.
std::string read_device_text(const std::string& name);

}  // namespace firmtouch::tools
