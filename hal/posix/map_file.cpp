#include "map_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace firmtouch::hal {

uint8_t* map_file(const char* path, uint32_t bytes) {
  if (path == nullptr) return nullptr;
  const int file = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  const bool is_open = file >= 0 && ::ftruncate(file, bytes) == 0;
  void* const at =
      is_open ? ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0) : MAP_FAILED;
  if (at == MAP_FAILED) {
    std::fprintf(stderr, "%s: cannot be opened for reading and writing\n", path);
    std::exit(3);
  }
  ::close(file);
  return static_cast<uint8_t*>(at);
}

}  // namespace firmtouch::hal
