#include "bench/peer.hpp"

#include <sys/wait.h>

#include <cerrno>
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

}  // namespace

double Peer::us_per_query(const std::string& kind, const std::string& file,
                          const std::string& csv) const {
  const std::string line = command_ + " " + kind + " " + quoted(file) + " " + quoted(csv);
  int status = 0;
  const std::string text = output_of(line, status);
  const char* const remedy = "; run it by hand, or leave --peer out";
  if (status != 0) {
    throw Problem("peer: " + line + (WIFEXITED(status) ? ": exit code " : ": ended by signal ") +
                  std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status)) +
                  remedy);
  }
  const std::string word = "us_per_query ";
  const size_t at = text.find(word);
  const double us =
      at == std::string::npos ? 0 : std::strtod(text.c_str() + at + word.size(), nullptr);
  if (!(us > 0 && us < 1e12))
    throw Problem("peer: " + line + ": printed no `us_per_query` above 0" + remedy);
  return us;
}

Contender Peer::contender(const std::string& kind, const std::string& file,
                          const std::string& csv) const {
  return [peer = *this, kind, file, csv] { return peer.us_per_query(kind, file, csv); };
}

}  // namespace firmtouch::bench
