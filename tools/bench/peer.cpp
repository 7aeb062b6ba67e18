#include "bench/peer.hpp"

#include <sys/wait.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bench/problem.hpp"

namespace firmtouch::bench {
namespace {

std::string quoted(const std::string& word) {  // for the shell
  std::string text = "'";
  for (const char letter : word)
    text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

// What the program printed; its messages go where ours go.
std::string output_of(const std::string& line, int& status) {
  std::fflush(nullptr);
  std::FILE* const pipe = popen(line.c_str(), "r");
  if (pipe == nullptr)
    throw Problem("peer: " + line + ": cannot be started: " + std::strerror(errno));
  std::string text;
  char block[4096];
  for (size_t count; (count = std::fread(block, 1, sizeof(block), pipe)) > 0;)
    text.append(block, count);
  status = pclose(pipe);
  return text;
}

// The number after a word; NaN where it is not there.
double number_after(const std::string& text, const std::string& word) {
  const size_t at = text.find(word);
  return at == std::string::npos ? std::nan("")
                                 : std::strtod(text.c_str() + at + word.size(), nullptr);
}

constexpr const char* kRemedy = "; run it by hand, or leave --peer out";

}  // namespace

std::string Peer::output(const std::string& kind, const std::string& file, const std::string& csv,
                         const std::string& option) const {
  const std::string line = command_ + " " + kind + " " + quoted(file) + " " + quoted(csv) +
                           (option.empty() ? "" : " " + option);
  int status = 0;
  const std::string text = output_of(line, status);
  if (status != 0) {
    throw Problem("peer: " + line + (WIFEXITED(status) ? ": exit code " : ": ended by signal ") +
                  std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)) +
                  kRemedy);
  }
  return text;
}

double Peer::us_per_query(const std::string& kind, const std::string& file, const std::string& csv,
                          const std::string& option) const {
  const double us = number_after(output(kind, file, csv, option), "us_per_query ");
  if (!(us > 0 && us < 1e12))
    throw Problem("peer: " + command_ + " " + kind + " " + file +
                  ": printed no `us_per_query` above 0" + kRemedy);
  return us;
}

double Peer::build_us(const std::string& kind, const std::string& file,
                      const std::string& csv) const {
  return number_after(output(kind, file, csv, ""), "build_s ") * 1e6;
}

Contender Peer::contender(const std::string& kind, const std::string& file, const std::string& csv,
                          const std::string& option) const {
  return [peer = *this, kind, file, csv, option] {
    return peer.us_per_query(kind, file, csv, option);
  };
}

}  // namespace firmtouch::bench
