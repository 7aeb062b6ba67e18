#include "link.hpp"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/link.hpp"

namespace firmtouch::hal {
namespace {

constexpr int kBadInput = 3;
// Short, because the main loop also polls the enable switch and the record ring (20 records at
// 10 kHz).
constexpr int kWait_ms = 2;

int g_link = -1;
bool g_is_socket = false;

[[noreturn]] void exit_with_error(const std::string& address, const char* what) {
  std::fprintf(stderr, "link %s: %s: %s\n", address.c_str(), what, std::strerror(errno));
  std::exit(kBadInput);
}

sockaddr_un unix_address(const std::string& address, const std::string& path) {
  sockaddr_un where{};
  where.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof where.sun_path) {
    errno = ENAMETOOLONG;
    exit_with_error(address, "a socket's path has 1 to 107 bytes");
  }
  std::memcpy(where.sun_path, path.c_str(), path.size() + 1);
  return where;
}

int connect_unix(const std::string& address, const std::string& path) {
  const sockaddr_un where = unix_address(address, path);
  const int link = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (link < 0 || ::connect(link, reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0) {
    exit_with_error(address,
                    "no program accepts connections there: start the host first, or use "
                    "listen:PATH");
  }
  return link;
}

int listen_unix(const std::string& address, const std::string& path) {
  const sockaddr_un where = unix_address(address, path);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (listener < 0 ||
      ::bind(listener, reinterpret_cast<const sockaddr*>(&where), sizeof where) != 0 ||
      ::listen(listener, 1) != 0) {
    exit_with_error(address, "cannot listen there: remove the old socket, or choose another path");
  }
  const int link = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
  if (link < 0) exit_with_error(address, "no connection could be accepted");
  ::close(listener);
  ::unlink(path.c_str());
  return link;
}

int connect_tcp(const std::string& address, const std::string& host_and_port) {
  const size_t colon = host_and_port.rfind(':');
  if (colon == std::string::npos) {
    errno = EINVAL;
    exit_with_error(address, "write tcp:HOST:PORT");
  }
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string host = host_and_port.substr(0, colon);
  const std::string port = host_and_port.substr(colon + 1);
  if (::getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) {
    errno = EADDRNOTAVAIL;
    exit_with_error(address, "unknown host or port");
  }
  int link = -1;
  for (const addrinfo* at = found; at != nullptr && link < 0; at = at->ai_next) {
    link = ::socket(at->ai_family, at->ai_socktype | SOCK_CLOEXEC, at->ai_protocol);
    if (link >= 0 && ::connect(link, at->ai_addr, at->ai_addrlen) != 0) {
      ::close(link);
      link = -1;
    }
  }
  ::freeaddrinfo(found);
  if (link < 0) exit_with_error(address, "no program accepts connections there");
  const int on = 1;  // send at once: Nagle's algorithm delays each frame by up to 40 ms
  ::setsockopt(link, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return link;
}

// Raw mode: no echo, no line editing, no signals from the keyboard.
void make_raw(const std::string& address, int link, speed_t baud) {
  termios line{};
  if (::tcgetattr(link, &line) != 0) exit_with_error(address, "not a serial device");
  ::cfmakeraw(&line);
  ::cfsetspeed(&line, baud);
  if (::tcsetattr(link, TCSANOW, &line) != 0)
    exit_with_error(address, "cannot be set to raw bytes");
}

int open_pty(const std::string& address) {
  const int link = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (link < 0 || ::grantpt(link) != 0 || ::unlockpt(link) != 0)
    exit_with_error(address, "no pseudo-terminal is available");
  const char* name = ::ptsname(link);
  if (name == nullptr) exit_with_error(address, "the pseudo-terminal has no name");
  // Stays open here too: bytes and settings survive a host that opens it late or twice.
  const int other = ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (other < 0) exit_with_error(address, name);
  make_raw(address, other, B1000000);
  std::printf("%s\n", name);
  std::fflush(stdout);
  return link;
}

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

int open_address(const std::string& address) {
  if (begins(address, "unix:")) return connect_unix(address, address.substr(5));
  if (begins(address, "listen:")) return listen_unix(address, address.substr(7));
  if (begins(address, "tcp:")) return connect_tcp(address, address.substr(4));
  if (begins(address, "fd:")) return std::atoi(address.c_str() + 3);
  if (address == "pty") return open_pty(address);
  const int link = ::open(address.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (link < 0) exit_with_error(address, "cannot be opened");
  make_raw(address, link, B1000000);
  return link;
}

// Without a link this process has nothing to do.
[[noreturn]] void exit_at_end_of_link() {
  board_print("link: the host closed the connection\n");
  board_exit(0);
}

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

void link_open(const char* address) {
  g_link = open_address(address);
  const int flags = ::fcntl(g_link, F_GETFL);
  if (flags < 0 || ::fcntl(g_link, F_SETFL, flags | O_NONBLOCK) != 0)
    exit_with_error(address, "not an open descriptor");
  int type = 0;
  socklen_t bytes = sizeof type;
  g_is_socket = ::getsockopt(g_link, SOL_SOCKET, SO_TYPE, &type, &bytes) == 0;
}

void link_drain() {
  if (g_link >= 0 && !g_is_socket) ::tcdrain(g_link);
}

uint32_t link_read(uint8_t* to, uint32_t capacity) {
  const ssize_t got = ::read(g_link, to, capacity);
  if (got > 0) return static_cast<uint32_t>(got);
  if (got == 0 && capacity > 0) exit_at_end_of_link();
  if (got < 0 && !would_block()) exit_at_end_of_link();
  return 0;
}

uint32_t link_write(const uint8_t* from, uint32_t count) {
  const ssize_t sent = ::write(g_link, from, count);
  if (sent >= 0) return static_cast<uint32_t>(sent);
  if (!would_block()) exit_at_end_of_link();
  pollfd link{g_link, POLLOUT, 0};  // the host does not read: wait 1 ms instead of spinning
  ::poll(&link, 1, 1);
  return 0;
}

void link_wait() {
  pollfd link{g_link, POLLIN, 0};
  ::poll(&link, 1, kWait_ms);
}

}  // namespace firmtouch::hal
