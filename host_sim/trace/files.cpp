#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  if (!in || std::filesystem::is_directory(path) || !(bytes << in.rdbuf()))
    if (!in || in.peek() != std::ifstream::traits_type::eof())
      throw Refused(path + ": cannot be read: " + std::strerror(errno));
  return bytes.str();
}

std::string partial_of(const std::string& path) { return path + ".partial"; }

void check_writable(const std::string& path) {
  const std::string partial = partial_of(path);
  const bool is_folder = std::filesystem::is_directory(path);
  std::ofstream out;
  if (!is_folder) out.open(partial, std::ios::binary);
  if (!is_folder && out) {
    out.close();
    std::remove(partial.c_str());
    return;
  }
  throw Refused(path + ": cannot be written: " + std::strerror(is_folder ? EISDIR : errno));
}

void write_file(const std::string& path, const std::string& bytes) {
  const std::string partial = partial_of(path);
  std::ofstream out(partial, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out && std::rename(partial.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  std::remove(partial.c_str());
  throw Refused(path + ": cannot be written: " + std::strerror(error));
}

}  // namespace firmtouch::host_sim
