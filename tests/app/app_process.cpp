#include "app/app_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "firmtouch/link/build_id.hpp"
#include "firmtouch/params/table.hpp"

namespace firmtouch::app_test {
namespace {

constexpr int kPatience_ms = 10000;

}  // namespace

link::Identity identity(uint32_t asset_crc) {
  link::Identity mine;
  mine.asset_crc = asset_crc;
  mine.parameter_table_hash = params::table_hash();
  mine.build_id = link::build_id();
  return mine;
}

AppProcess::AppProcess(const std::string& asset) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return;
  link_ = ends[0];
  ::fcntl(link_, F_SETFD, FD_CLOEXEC);
  start({"--asset", asset, "--link", "fd:" + std::to_string(ends[1])});  // open across exec
  ::close(ends[1]);
}

AppProcess::AppProcess(const std::vector<std::string>& options) { start(options); }

void AppProcess::start(const std::vector<std::string>& options) {
  std::signal(SIGPIPE, SIG_IGN);
  int print[2];
  if (::pipe2(print, O_CLOEXEC) != 0) return;
  std::vector<std::string> words{FIRMTOUCH_APP_PROGRAM};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) {
    ::dup2(print[1], 1);
    ::dup2(print[1], 2);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(print[1]);
  printed_ = print[0];
}

AppProcess::~AppProcess() {
  close_link();
  if (printed_ >= 0) ::close(printed_);
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
}

bool AppProcess::connect(const std::string& unix_path) {
  sockaddr_un where{};
  where.sun_family = AF_UNIX;
  if (unix_path.size() >= sizeof where.sun_path) return false;
  std::memcpy(where.sun_path, unix_path.c_str(), unix_path.size() + 1);
  link_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  for (int waited_ms = 0; waited_ms < kPatience_ms; waited_ms += 10) {
    if (::connect(link_, reinterpret_cast<const sockaddr*>(&where), sizeof where) == 0) return true;
    ::usleep(10000);
  }
  return false;
}

bool AppProcess::open_terminal(const std::string& device) {
  link_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  return link_ >= 0;
}

std::string AppProcess::first_line() {
  std::string line;
  char c = 0;
  pollfd ready{printed_, POLLIN, 0};
  while (::poll(&ready, 1, kPatience_ms) > 0 && ::read(printed_, &c, 1) == 1 && c != '\n')
    line += c;
  return line;
}

void AppProcess::send_bytes(const std::vector<uint8_t>& bytes) {
  for (size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = ::write(link_, bytes.data() + sent, bytes.size() - sent);
    if (count <= 0) return;  // the missing answer shows it
    sent += static_cast<size_t>(count);
  }
}

uint16_t AppProcess::send_frame(uint8_t type, core::Bytes payload) {
  uint8_t bytes[link::kMaxFrameBytes];
  const uint32_t count = link::encode(type, ++sequence_, payload, bytes);
  send_bytes({bytes, bytes + count});
  return sequence_;
}

Message AppProcess::receive(uint8_t type) {
  for (;;) {
    link::Frame frame;
    while (decoder_.next(frame)) {
      if (type != 0 && frame.type != type) continue;
      return {frame.type, frame.sequence, {frame.payload.begin(), frame.payload.end()}};
    }
    if (waiting_.empty()) {
      uint8_t bytes[512];
      pollfd ready{link_, POLLIN, 0};
      if (::poll(&ready, 1, kPatience_ms) <= 0) return {};
      const ssize_t count = ::read(link_, bytes, sizeof bytes);
      if (count <= 0) return {};
      waiting_.assign(bytes, bytes + count);
    }
    decoder_.push(waiting_.front());
    waiting_.erase(waiting_.begin());
  }
}

void AppProcess::close_link() {
  if (link_ >= 0) ::close(link_);
  link_ = -1;
}

int AppProcess::wait() {
  for (int waited_ms = 0; waited_ms < kPatience_ms; waited_ms += 5) {
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == process_) {
      process_ = -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    ::usleep(5000);
  }
  return -1;
}

}  // namespace firmtouch::app_test
