#include "firmtouch/hal/board.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "link.hpp"
#include "options.hpp"

namespace firmtouch::hal {
namespace {

constexpr int kBadInput = 3;

core::Bytes map_asset(const char* path) {
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  struct stat about {};
  if (file < 0 || ::fstat(file, &about) != 0) {
    std::fprintf(stderr, "%s: %s: name an asset that exists (firmtouch bake makes one)\n", path,
                 std::strerror(errno));
    std::exit(kBadInput);
  }
  if (about.st_size == 0 || about.st_size > 0x7FFFFFFF) {
    std::fprintf(stderr, "%s: %lld bytes: an asset has between 1 byte and 2 GiB\n", path,
                 static_cast<long long>(about.st_size));
    std::exit(kBadInput);
  }
  const size_t bytes = static_cast<size_t>(about.st_size);
  void* at =
      ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, file, 0);  // page-aligned, so 16-byte aligned
  ::close(file);
  if (at == MAP_FAILED) {
    std::fprintf(stderr, "%s: cannot be mapped: %s\n", path, std::strerror(errno));
    std::exit(kBadInput);
  }
  return {static_cast<const uint8_t*>(at), static_cast<uint32_t>(bytes)};
}

}  // namespace

void board_begin() {
  std::signal(SIGPIPE, SIG_IGN);  // a closed link is reported by write(), not by a signal
  link_open(options().link);
}

const char* board_name() { return "posix"; }

core::Bytes board_asset() {
  static const core::Bytes asset = map_asset(options().asset);
  return asset;
}

void board_print(const char* text) { std::fputs(text, stderr); }

void board_exit(int status) {
  link_drain();
  std::_Exit(status);  // no destructors: the servo thread may be in a tick
}

bool board_may_exit() { return true; }

uint32_t board_stack_high_bytes() { return 0; }

}  // namespace firmtouch::hal
