#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "log/sample_log.hpp"

namespace firmtouch::log_test {

Folder::Folder() {
  const char* base = std::getenv("TMPDIR");
  name = std::string(base != nullptr ? base : "/tmp") + "/firmtouch-log-XXXXXX";
  if (::mkdtemp(name.data()) == nullptr) std::abort();
}
Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(name, ignored);
}

}  // namespace firmtouch::log_test
