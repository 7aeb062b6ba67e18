#pragma once
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "firmtouch/link/decoder.hpp"
#include "firmtouch/link/protocol.hpp"

namespace firmtouch::app_test {

/// One frame that came, with its own copy of the payload.
struct Message {
  uint8_t type = 0;  // 0: none came in time
  uint16_t sequence = 0;
  std::vector<uint8_t> payload;

  template <class T>
  bool take(T& value) const {
    link::Frame frame;
    frame.payload = {payload.data(), static_cast<uint32_t>(payload.size())};
    return link::take(frame, value);
  }
  std::string text() const { return {payload.begin(), payload.end()}; }
};

/// The controller program in a process of its own, and this end of its link.
class AppProcess {
 public:
  /// Starts it with `--asset asset --link <a socket pair>`.
  explicit AppProcess(const std::string& asset);
  /// Starts it with these options; connect() or open_terminal() makes the link.
  explicit AppProcess(const std::vector<std::string>& options);
  AppProcess(const AppProcess&) = delete;
  AppProcess& operator=(const AppProcess&) = delete;
  ~AppProcess();  // ends it if it still runs

  bool connect(const std::string& unix_path);
  bool open_terminal(const std::string& device);
  /// The first line that it prints.
  std::string first_line();

  void send_bytes(const std::vector<uint8_t>& bytes);
  template <class T>
  uint16_t send(uint8_t type, const T& payload) {
    return send_frame(type, link::bytes_of(payload));
  }
  uint16_t send_frame(uint8_t type, core::Bytes payload);
  /// The next frame, or the next of this type (others are passed over). Waits up to 10 s.
  Message receive(uint8_t type = 0);
  void close_link();
  /// Waits for its end. Result: exit status, or -1 where it does not end by itself.
  int wait();

 private:
  void start(const std::vector<std::string>& options);

  pid_t process_ = -1;
  int link_ = -1;
  int printed_ = -1;
  uint16_t sequence_ = 0;
  link::Decoder decoder_;
  std::vector<uint8_t> waiting_;
};

/// Identity of this program, as a host sends it.
link::Identity identity(uint32_t asset_crc);

}  // namespace firmtouch::app_test
