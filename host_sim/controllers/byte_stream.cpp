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

// As connect(), but not beyond `time`. Result: false with errno.
bool connect_in_time(int fd, const addrinfo& to, AnswerTime& time) {
  const int flags = fcntl(fd, F_GETFL);
  fcntl(fd, F_SETFL, flags | O_NONBLOCK);
  int error = connect(fd, to.ai_addr, to.ai_addrlen) == 0 ? 0 : errno;
  while (error == EINPROGRESS) {
    pollfd ready{fd, POLLOUT, 0};
    socklen_t size = sizeof error;
    if (poll(&ready, 1, time.wait_ms(1000)) > 0)
      getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size);
    else if (time.is_over())
      error = ETIMEDOUT;
  }
  fcntl(fd, F_SETFL, flags);
  errno = error;
  return error == 0;
}

int connect_tcp(const std::string& where, double wait_s) {
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
  AnswerTime time("tcp:" + where + ": no connection", wait_s);
  for (const addrinfo* a = found; a != nullptr && fd < 0; a = a->ai_next) {
    fd = socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (fd < 0 || connect_in_time(fd, *a, time)) continue;
    why = errno == ETIMEDOUT ? time.text() : reason();
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
  const int fd = open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
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

std::string ByteStream::why_silent() const {
  return received_ == 0
             ? "nothing came: is it powered, does it run firmtouch_app, is this its port?"
             : std::to_string(received_) +
                   " bytes came, and no answer: does it run firmtouch_app, and the "
                   "serial line 1 Mbaud?";
}

void ByteStream::write(const uint8_t* from, uint32_t count) {
  AnswerTime time(name_ + ": the controller accepts no bytes", wait_s_);
  while (count > 0) {
    pollfd ready{out_, POLLOUT, 0};
    if (poll(&ready, 1, time.wait_ms(1000)) == 0) {
      if (time.is_over()) throw Refused(time.text() + "; is the controller halted?");
      continue;
    }
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
  received_ += static_cast<uint64_t>(got);
  return static_cast<uint32_t>(got);
}

std::unique_ptr<ByteStream> connect_stream(const std::string& where, double wait_s) {
  int fd;
  if (where.compare(0, 5, "unix:") == 0)
    fd = connect_unix(where.substr(5));
  else if (where.compare(0, 4, "tcp:") == 0)
    fd = connect_tcp(where.substr(4), wait_s);
  else
    fd = open_serial(where);
  auto stream = std::make_unique<ByteStream>(fd, fd, where);
  stream->set_wait_s(wait_s);
  return stream;
}

}  // namespace firmtouch::host_sim
