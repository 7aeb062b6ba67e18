// The host's main of every test program: `test_MODULE [--list | NAME]`.
#include <cstdio>
#include <cstring>

#include "harness/test.hpp"

int main(int argc, char** argv) {
  firmtouch::test::print = [](const char* text) { std::fputs(text, stdout); };
  if (argc > 1 && std::strcmp(argv[1], "--list") == 0) return firmtouch::test::list(), 0;
  return firmtouch::test::run(argc > 1 ? argv[1] : nullptr);
}
