#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "firmtouch/link/decoder.hpp"
#include "host_sim/controllers/byte_stream.hpp"
#include "host_sim/live/web_socket.hpp"

namespace firmtouch::host_sim {

/// Serves the live page to browsers of this machine, and carries the frames of one controller to
/// the page that holds the link: one WebSocket message a frame. Another page waits until it takes
/// the link over, or the first one leaves. Pages of another origin get neither the page nor the
/// link.
class LiveServer {
 public:
  /// Listens on 127.0.0.1. Throws Refused if the port is taken. `stream`: nullptr: page only.
  LiveServer(uint16_t port, std::string page, std::unique_ptr<ByteStream> stream);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  /// Serves for up to `timeout_ms`. Throws Refused if the controller closed its link; the pages
  /// have been notified then.
  void poll(int timeout_ms);

 private:
  struct Client {
    int socket = -1;
    bool is_page = false;  // speaks WebSocket
    bool is_ending = false;
    std::string received, waiting;
  };
  void accept_client();
  void read(Client& client);
  void answer(Client& client, const std::string& head);
  void take(Client& client, const Message& message);
  void read_controller();
  void give_link(int socket);
  void send_text(Client& client, const std::string& text) const;
  void write(Client& client) const;
  bool is_own(const std::string& host) const;

  int listener_ = -1;
  uint16_t port_;
  std::string page_;
  std::unique_ptr<ByteStream> stream_;
  link::Decoder decoder_;
  uint32_t rejects_ = 0;
  std::vector<Client> clients_;
  int holder_ = -1;  // socket of the page that holds the link
};

}  // namespace firmtouch::host_sim
