#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::cli {

/// Every byte of a file; -: of standard input. Fails (bad input) where it cannot be opened or read.
std::vector<uint8_t> read_file(const std::string& path);
/// The same for a model, curve or table: a line without an end is refused before it fills the
/// memory.
std::vector<uint8_t> read_model(const std::string& path);
std::string read_standard_input();
/// Fails (bad input) where `path` is a pipe or a device: for a file that is read twice.
void forbid_pipe(const std::string& path);

/// Fails (bad input) where `path` is a folder or lies in none: before work that would be lost.
/// -: is standard output.
void check_output(const std::string& path);

/// Writes a file whole or not at all: to a temporary beside it, renamed at the end. A failing
/// command leaves no output. A device or a pipe is written to. -: to standard output.
void write_file(const std::string& path, const void* bytes, size_t count);

/// "dir/spot.final.obj": stem "spot.final", extension ".obj" (lower case), file name
/// "spot.final.obj".
std::string stem_of(const std::string& path);
std::string extension_of(const std::string& path);
std::string file_name_of(const std::string& path);

/// Fails (usage) where writing `output` would overwrite the input `input`.
void forbid_overwriting(const std::string& output, const std::string& input);

}  // namespace firmtouch::cli
