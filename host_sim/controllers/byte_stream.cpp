#include "host_sim/controllers/byte_stream.hpp"

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
#include <cstring>

#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr int kWriteTimeout_ms = 20000;

std::string reason() { return std::strerror(errno); }

int connect_unix(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw Refused("unix:" + path + ": a socket's path has at most " +
                  std::to_string(sizeof address.sun_path - 1) + " bytes");
  std::memcpy(address.sun_path, path.data(), path.size());
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd >= 0 && connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    return fd;
  const std::string why = reason();
  if (fd >= 0) close(fd);
  throw Refused("unix:" + path + ": " + why + "; is the controller running and listening there?");
}

int connect_tcp(const std::string& where) {
  const size_t colon = where.rfind(':');
  if (colon == std::string::npos) throw Refused("tcp:" + where + ": write tcp:HOST:PORT");
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int status =
      getaddrinfo(where.substr(0, colon).c_str(), where.substr(colon + 1).c_str(), &hints, &found);
  if (status != 0) throw Refused("tcp:" + where + ": " + gai_strerror(status));
  int fd = -1;
  std::string why = "no address";
  for (const addrinfo* a = found; a != nullptr && fd < 0; a = a->ai_next) {
    fd = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (fd < 0 || connect(fd, a->ai_addr, a->ai_addrlen) == 0) continue;
    why = reason();
    close(fd);
    fd = -1;
  }
  freeaddrinfo(found);
  if (fd < 0)
    throw Refused("tcp:" + where + ": " + why + "; is the controller running and listening there?");
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return fd;
}

int open_serial(const std::string& device) {
  const int fd = open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (fd < 0)
    throw Refused(
        device + ": " + reason() +
        "; a controller is inproc, qemu:BOARD, unix:PATH, tcp:HOST:PORT or a serial device");
  termios settings{};
  if (tcgetattr(fd, &settings) != 0) {
    close(fd);
    throw Refused(device +
                  ": not a serial device; a controller is inproc, qemu:BOARD, unix:PATH, "
                  "tcp:HOST:PORT or a serial device");
  }
  cfmakeraw(&settings);
  cfsetspeed(&settings, B1000000);
  settings.c_cflag |= CLOCAL | CREAD;
  tcsetattr(fd, TCSANOW, &settings);
  tcflush(fd, TCIOFLUSH);
  return fd;
}

}  // namespace

ByteStream::~ByteStream() {
  if (in_ >= 0) close(in_);
  if (out_ >= 0 && out_ != in_) close(out_);
}

void ByteStream::write(const uint8_t* from, uint32_t count) {
  while (count > 0) {
    pollfd ready{out_, POLLOUT, 0};
    if (poll(&ready, 1, kWriteTimeout_ms) == 0)
      throw Refused(name_ + ": the controller accepts no more bytes; is it halted?");
    const ssize_t sent = ::write(out_, from, count);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (sent <= 0) throw Refused(name_ + ": the controller closed the link" + reason_closed());
    from += sent;
    count -= static_cast<uint32_t>(sent);
  }
}

uint32_t ByteStream::read(uint8_t* to, uint32_t capacity, int timeout_ms) {
  pollfd ready{in_, POLLIN, 0};
  int status;
  do status = poll(&ready, 1, timeout_ms);
  while (status < 0 && errno == EINTR);
  if (status == 0) return 0;
  const ssize_t got = ::read(in_, to, capacity);
  if (got < 0 && (errno == EINTR || errno == EAGAIN)) return 0;
  if (got <= 0) throw Refused(name_ + ": the controller closed the link" + reason_closed());
  return static_cast<uint32_t>(got);
}

std::unique_ptr<ByteStream> connect_stream(const std::string& where) {
  int fd;
  if (where.compare(0, 5, "unix:") == 0)
    fd = connect_unix(where.substr(5));
  else if (where.compare(0, 4, "tcp:") == 0)
    fd = connect_tcp(where.substr(4));
  else
    fd = open_serial(where);
  return std::make_unique<ByteStream>(fd, fd, where);
}

}  // namespace firmtouch::host_sim
