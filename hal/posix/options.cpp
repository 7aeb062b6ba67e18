#include "options.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace firmtouch::hal {
namespace {

constexpr const char* kUsage =
    "usage: firmtouch-app-posix --asset FILE.fta --link LINK [--parameters FILE] [--slots FILE]\n"
    "Runs the controller program as a process, without motors and encoders. A host sends one tick\n"
    "at a time over the link (firmtouch-sim run --controller).\n"
    "FILE of --parameters keeps what a host saves, FILE of --slots the assets that it loads; each\n"
    "is created. A loaded asset is used instead of the one of --asset.\n"
    "LINK: unix:PATH       connect to a unix socket\n"
    "      listen:PATH     create a unix socket and wait for one host\n"
    "      tcp:HOST:PORT   connect\n"
    "      fd:N            an open file descriptor (a socket pair)\n"
    "      pty             create a pseudo-terminal and print its name\n"
    "      /dev/...        a serial device, 1 Mbaud, raw\n";

[[noreturn]] void leave(int status, const std::string& message) {
  std::fputs(message.c_str(), stderr);
  std::fputs(kUsage, stderr);
  std::exit(status);
}

// main() is the same on every board and has no arguments, so the command line comes from /proc.
std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<std::string> words;
  for (size_t at = 0; at < all.size(); at += words.back().size() + 1)
    words.emplace_back(all.c_str() + at);
  return words;
}

Options read() {
  static const std::vector<std::string> words = command_line();
  Options found;
  for (size_t i = 1; i < words.size(); ++i) {
    if (words[i] == "--help") leave(0, "");
    const bool has_value = i + 1 < words.size();
    if (words[i] == "--link" && has_value) {
      found.link = words[++i].c_str();
    } else if (words[i] == "--asset" && has_value) {
      found.asset = words[++i].c_str();
    } else if (words[i] == "--parameters" && has_value) {
      found.parameters = words[++i].c_str();
    } else if (words[i] == "--slots" && has_value) {
      found.slots = words[++i].c_str();
    } else {
      leave(2,
            "firmtouch-app-posix: `" + words[i] + "` is not an option, or its value is missing\n");
    }
  }
  if (found.link == nullptr || found.asset == nullptr) {
    leave(2, "firmtouch-app-posix: give --asset and --link\n");
  }
  return found;
}

}  // namespace

const Options& options() {
  static const Options options = read();
  return options;
}

}  // namespace firmtouch::hal
