#include "live/browser.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace firmtouch::live_test {
namespace {

using Clock = std::chrono::steady_clock;
// The browser reads commands from descriptor 3 and writes answers to 4, each ended by a zero.
constexpr int kCommands = 3, kAnswers = 4;

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out + "\"";
}

// The text behind "key": in an answer of the browser's, whose keys stand without blanks. Enough for
// the few that are read here; \uXXXX beyond ASCII becomes '?'.
std::string text_of(const std::string& answer, const std::string& key) {
  const size_t at = answer.find("\"" + key + "\":\"");
  if (at == std::string::npos) return {};
  std::string out;
  for (size_t i = at + key.size() + 4; i < answer.size() && answer[i] != '"'; ++i) {
    if (answer[i] != '\\') {
      out += answer[i];
    } else if (answer[++i] == 'u') {
      out += '?';
      i += 4;
    } else {
      out += answer[i] == 'n' ? '\n' : answer[i];
    }
  }
  return out;
}

std::string bytes_of_base64(const std::string& text) {
  std::string out;
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t digit = std::string(digits).find(c);
    if (digit == std::string::npos) break;
    bits = (bits << 6) | static_cast<uint32_t>(digit);
    count += 6;
    if (count >= 8) out += static_cast<char>((bits >> (count -= 8)) & 255u);
  }
  return out;
}

}  // namespace

Browser::Browser(const std::string& program, const std::string& folder) {
  ::signal(SIGPIPE, SIG_IGN);  // a browser that ended is a failed claim
  int commands[2], answers[2];
  if (::pipe2(commands, O_CLOEXEC) != 0 || ::pipe2(answers, O_CLOEXEC) != 0) return;
  process_ = ::fork();
  if (process_ == 0) {
    ::setpgid(0, 0);
    // First out of the way of 3 and 4 themselves.
    const int in = ::fcntl(commands[0], F_DUPFD_CLOEXEC, 10);
    const int out = ::fcntl(answers[1], F_DUPFD_CLOEXEC, 10);
    ::dup2(in, kCommands);
    ::dup2(out, kAnswers);
    const int quiet =
        ::open((folder + "/browser.log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    if (quiet >= 0) ::dup2(quiet, 1), ::dup2(quiet, 2);
    const std::string profile = "--user-data-dir=" + folder + "/profile";
    ::execlp(program.c_str(), program.c_str(), "--headless=new", "--no-sandbox", "--disable-gpu",
             "--no-first-run", "--disable-extensions", "--disable-background-networking",
             "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
             "--hide-scrollbars", "--remote-debugging-pipe", profile.c_str(), "about:blank",
             static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(commands[0]);
  ::close(answers[1]);
  to_ = commands[1];
  from_ = answers[0];
}

Browser::~Browser() {
  if (process_ > 0) {
    ::kill(-process_, SIGKILL);
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  ::close(to_);
  ::close(from_);
}

bool Browser::open(const std::string& url, int width, int height) {
  session_.clear();
  const std::string target =
      text_of(call("Target.createTarget", "{\"url\":\"about:blank\"}", 20000), "targetId");
  if (target.empty()) return false;
  session_ = text_of(call("Target.attachToTarget",
                          "{\"targetId\":" + in_quotes(target) + ",\"flatten\":true}", 5000),
                     "sessionId");
  if (session_.empty()) return false;
  call("Runtime.enable", "{}", 5000);
  call("Log.enable", "{}", 5000);
  call("Page.setDownloadBehavior", "{\"behavior\":\"deny\"}", 5000);
  resize(width, height);
  return !text_of(call("Page.navigate", "{\"url\":" + in_quotes(url) + "}", 10000), "frameId")
              .empty();
}

void Browser::resize(int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       "{\"width\":" + std::to_string(width) + ",\"height\":" + std::to_string(height) +
           ",\"deviceScaleFactor\":1,\"mobile\":false}",
       5000);
}

std::string Browser::evaluate(const std::string& expression) {
  const std::string wrapped = "(async () => String(await (" + expression + ")))()";
  return text_of(call("Runtime.evaluate",
                      "{\"expression\":" + in_quotes(wrapped) +
                          ",\"awaitPromise\":true,\"returnByValue\":true}",
                      10000),
                 "value");
}

bool Browser::picture(const std::string& path) {
  const std::string bytes = bytes_of_base64(
      text_of(call("Page.captureScreenshot", "{\"format\":\"png\"}", 10000), "data"));
  std::FILE* out = std::fopen(path.c_str(), "wb");
  if (out == nullptr) return false;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
  return std::fclose(out) == 0 && whole && !bytes.empty();
}

void Browser::note(const std::string& event) {
  const auto has = [&](const char* text) { return event.find(text) != std::string::npos; };
  if (has("\"method\":\"Runtime.exceptionThrown\""))
    errors_ += text_of(event, "description") + "\n";
  else if (has("\"method\":\"Runtime.consoleAPICalled\"") && has("\"type\":\"error\""))
    errors_ += "console: " + text_of(event, "value") + "\n";
  else if (has("\"method\":\"Log.entryAdded\"") && has("\"level\":\"error\""))
    errors_ += "log: " + text_of(event, "text") + "\n";
}

// Result: the answer's text; empty where none came in time.
std::string Browser::call(const std::string& method, const std::string& parameters,
                          int timeout_ms) {
  const std::string id = std::to_string(++last_id_);
  std::string message = "{\"id\":" + id + ",\"method\":\"" + method + "\",\"params\":" + parameters;
  if (!session_.empty()) message += ",\"sessionId\":" + in_quotes(session_);
  message += '}';
  message += '\0';
  for (size_t at = 0; at < message.size();) {
    const ssize_t sent = ::write(to_, message.data() + at, message.size() - at);
    if (sent <= 0) return {};
    at += static_cast<size_t>(sent);
  }
  const std::string begins = "{\"id\":" + id + ",";
  const auto end = Clock::now() + std::chrono::milliseconds(timeout_ms);
  for (;;) {
    for (size_t zero; (zero = waiting_.find('\0')) != std::string::npos;) {
      const std::string answer = waiting_.substr(0, zero);
      waiting_.erase(0, zero + 1);
      if (answer.rfind(begins, 0) == 0) return answer;
      note(answer);
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    pollfd ready{from_, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count())) <= 0) return {};
    char bytes[65536];
    const ssize_t got = ::read(from_, bytes, sizeof bytes);
    if (got <= 0) return {};
    waiting_.append(bytes, static_cast<size_t>(got));
  }
}

}  // namespace firmtouch::live_test
