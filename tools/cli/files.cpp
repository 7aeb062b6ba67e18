#include "cli/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "cli/failure.hpp"
#include "log/file_sink.hpp"
#include "surface/read/load_file.hpp"

namespace firmtouch::cli {
namespace {

std::string reason() { return std::strerror(errno); }

bool is_gz(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return extension == ".gz" || extension == ".GZ";
}

std::vector<uint8_t> taken(tools::LoadedFile file, const std::string& name) {
  if (!file.problem.empty()) fail_input(name + ": " + file.problem);
  return std::move(file.bytes);
}

}  // namespace

std::vector<uint8_t> read_file(const std::string& path) {
  if (path == "-") return taken(tools::load_stream(stdin, SIZE_MAX), "standard input");
  return taken(tools::load_file(path, SIZE_MAX), path);
}

std::vector<uint8_t> read_model(const std::string& path) {
  return taken(tools::load_file(path, tools::kMaxLineBytes), path);
}

std::string read_standard_input() {
  const std::vector<uint8_t> bytes =
      taken(tools::load_stream(stdin, tools::kMaxLineBytes), "standard input");
  return {bytes.begin(), bytes.end()};
}

void forbid_pipe(const std::string& path) {
  if (log::is_special(path))
    fail_input(path + ": is a pipe or a device, and it is read twice; copy it to a file first");
}

void check_output(const std::string& path) {
  if (path == "-") return;
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    fail_input(path + ": is a folder; name a file in it");
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    fail_input(path + ": cannot be written: there is no folder " + folder.string() +
               "; make it, or name a file elsewhere");
}

void write_file(const std::string& path, const void* bytes, size_t count) {
  if (path == "-") {  // run_program() reports what cannot be written
    std::fwrite(bytes, 1, count, stdout);
    return;
  }
  check_output(path);
  const std::string temporary = log::is_special(path) ? path : path + ".part";
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr)
    fail_input(path + ": cannot be written: " + reason() + "; name a file elsewhere");
  const bool written = std::fwrite(bytes, 1, count, file) == count;
  const bool closed = std::fclose(file) == 0;
  if (written && closed && (temporary == path || std::rename(temporary.c_str(), path.c_str()) == 0))
    return;
  const std::string why = reason();
  if (temporary != path) std::remove(temporary.c_str());
  fail_input(path + ": cannot be written: " + why + "; free the disk, or name a file elsewhere");
}

std::string stem_of(const std::string& path) {
  const std::filesystem::path stem = std::filesystem::path(path).stem();
  return (is_gz(path) ? stem.stem() : stem).string();
}

std::string extension_of(const std::string& path) {
  const std::string extension = tools::model_extension(path);
  return extension.empty() ? extension : "." + extension;
}

std::string file_name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void forbid_overwriting(const std::string& output, const std::string& input) {
  std::error_code error;
  if (std::filesystem::equivalent(output, input, error) && !error) {
    fail_usage("-o " + output + " would overwrite the input " + input + "; name another file");
  }
}

}  // namespace firmtouch::cli
