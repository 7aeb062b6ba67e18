// `answers_host ASSET`: what tests/target/answers_main.cpp prints on a board, on this machine.
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "target/answers.hpp"
#include "target/text.hpp"

namespace target = firmtouch::target;

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "answers_host ASSET\n"), 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  struct alignas(16) Unit {
    uint8_t bytes[16];
  };
  std::vector<Unit> place(bytes.size() / sizeof(Unit) + 1);
  uint8_t* const at = place.data()->bytes;
  for (size_t i = 0; i < bytes.size(); ++i) at[i] = static_cast<uint8_t>(bytes[i]);
  const target::Views views = target::open_views({at, static_cast<uint32_t>(bytes.size())});
  if (!views.verdict.ok()) {
    std::fprintf(stderr, "%s: rejected by rule %u\n", argv[1], views.verdict.rule);
    return 1;
  }
  std::printf("answers %s\n", target::hexadecimal(target::hash_answers(views, 6000)).text);
  return 0;
}
