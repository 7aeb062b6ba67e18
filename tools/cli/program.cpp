#include "cli/program.hpp"

#include <cstdio>
#include <exception>
#include <new>

#include "cli/failure.hpp"

namespace firmtouch::cli {

int run_program(const char* name, int (*run)(const std::vector<std::string>& words), int argc,
                char** argv) {
  try {
    const int code = run({argv + 1, argv + argc});
    // A full disk or a closed pipe must not pass for success.
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    std::fprintf(stderr, "%s: standard output: cannot be written\n", name);
    return kBadInput;
  } catch (const Failure& failure) {
    std::fprintf(stderr, "%s: %s\n", name, failure.message.c_str());
    return failure.exit_code;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr,
                 "%s: not enough memory for this input: use fewer or smaller inputs at once\n",
                 name);
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return kBadInput;
  }
}

}  // namespace firmtouch::cli
