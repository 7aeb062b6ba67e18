#include "host_sim/live/live_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "firmtouch/link/frame.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr size_t kMaxHead = 16384;
// A browser that does not read loses records, and nothing else.
constexpr size_t kMaxWaiting = 4u << 20;
constexpr size_t kMaxClients = 32;

std::string response(const std::string& status, const std::string& type, const std::string& body) {
  return "HTTP/1.1 " + status + "\r\nContent-Type: " + type +
         "; charset=utf-8\r\nContent-Length: " + std::to_string(body.size()) +
         "\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nConnection: "
         "close\r\n\r\n" +
         body;
}

}  // namespace

LiveServer::LiveServer(uint16_t port, std::string page, std::unique_ptr<ByteStream> stream)
    : port_(port), page_(std::move(page)), stream_(std::move(stream)) {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(listener_, 8) != 0) {
    const std::string why = std::strerror(errno);
    ::close(listener_);
    throw Refused("port " + std::to_string(port) + ": " + why + "; name another one with --port");
  }
}

LiveServer::~LiveServer() {
  for (const Client& client : clients_) ::close(client.socket);
  ::close(listener_);
}

void LiveServer::poll(int timeout_ms) {
  std::vector<pollfd> ready{{listener_, POLLIN, 0}};
  if (stream_ != nullptr) ready.push_back({stream_->descriptor(), POLLIN, 0});
  const size_t first = ready.size();
  for (const Client& client : clients_) {
    // One that is ending is read no more: it may have closed its own direction.
    const short events = client.is_ending         ? POLLOUT
                         : client.waiting.empty() ? POLLIN
                                                  : POLLIN | POLLOUT;
    ready.push_back({client.socket, events, 0});
  }
  if (::poll(ready.data(), ready.size(), timeout_ms) <= 0) return;
  for (size_t i = first; i < ready.size(); ++i) {
    Client& client = clients_[i - first];
    if ((ready[i].revents & (POLLIN | POLLHUP | POLLERR)) != 0) read(client);
  }
  if ((ready[0].revents & POLLIN) != 0) accept_client();
  if (stream_ != nullptr && (ready[1].revents & (POLLIN | POLLHUP)) != 0) read_controller();
  for (Client& client : clients_) write(client);
  for (const Client& client : clients_) {
    if (client.socket < 0 || !client.is_ending || !client.waiting.empty()) continue;
    ::close(client.socket);
    if (client.socket == holder_) holder_ = -1;
  }
  clients_.erase(std::remove_if(clients_.begin(), clients_.end(),
                                [](const Client& c) { return c.is_ending && c.waiting.empty(); }),
                 clients_.end());
  if (holder_ >= 0) return;
  const auto next = std::find_if(clients_.begin(), clients_.end(),
                                 [](const Client& c) { return c.is_page && !c.is_ending; });
  if (next != clients_.end()) give_link(next->socket);
}

void LiveServer::accept_client() {
  const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (socket < 0) return;
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  clients_.push_back({});
  clients_.back().socket = socket;
  if (clients_.size() > kMaxClients) clients_.back().is_ending = true;
}

void LiveServer::read(Client& client) {
  char bytes[16384];
  const ssize_t count = ::read(client.socket, bytes, sizeof bytes);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) {
    client.is_ending = true;
    client.waiting.clear();
    return;
  }
  client.received.append(bytes, static_cast<size_t>(count));
  while (!client.is_page && !client.is_ending) {
    const size_t end = client.received.find("\r\n\r\n");
    if (end == std::string::npos) {
      if (client.received.size() <= kMaxHead) return;
      client.is_ending = true;
      client.waiting =
          response("431 Request Header Fields Too Large", "text/plain",
                   "the request's head has more than " + std::to_string(kMaxHead) +
                       " bytes; delete the cookies of other pages of this machine, or use a "
                       "private window\n");
      return;
    }
    const std::string head = client.received.substr(0, end + 4);
    client.received.erase(0, end + 4);
    answer(client, head);
  }
  Message message;
  while (client.is_page && !client.is_ending) {
    const Taken taken = take_message(client.received, message);
    if (taken == Taken::kNone) return;
    if (taken == Taken::kBroken) client.is_ending = true;
    if (taken == Taken::kOne) take(client, message);
  }
}

// Under a foreign name in `Host` a page of another origin could read this one (DNS rebinding).
bool LiveServer::is_own(const std::string& host) const {
  const std::string port = ":" + std::to_string(port_);
  return host == "127.0.0.1" + port || host == "localhost" + port;
}

void LiveServer::answer(Client& client, const std::string& head) {
  Request request;
  const bool is_get = parse_request(head, request);
  const bool is_own_page =
      is_own(request.host) &&
      (request.origin.empty() ||
       (request.origin.compare(0, 7, "http://") == 0 && is_own(request.origin.substr(7))));
  client.is_ending = true;
  if (!is_get) {
    client.waiting = response("405 Method Not Allowed", "text/plain", "only GET is served\n");
  } else if (!is_own_page) {
    client.waiting = response(
        "403 Forbidden", "text/plain",
        "this page may only be used from http://127.0.0.1:" + std::to_string(port_) + "/\n");
  } else if (request.path == "/") {
    client.waiting = response("200 OK", "text/html", page_);
  } else if (request.path == "/link" && stream_ != nullptr && !request.key.empty() &&
             !request.origin.empty()) {
    client.waiting =
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Accept: " +
        accept_of(request.key) + "\r\n\r\n";
    client.is_ending = false;
    client.is_page = true;
    if (holder_ < 0)
      give_link(client.socket);
    else
      send_text(client, "held");
  } else {
    client.waiting = response("404 Not Found", "text/plain", "there is no such page\n");
  }
}

void LiveServer::give_link(int socket) {
  for (Client& client : clients_) {
    if (client.socket == holder_ && holder_ != socket) send_text(client, "held");
    if (client.socket == socket) send_text(client, "yours");
  }
  holder_ = socket;
}

void LiveServer::take(Client& client, const Message& message) {
  if (message.opcode == Opcode::kClose) client.is_ending = true;
  if (message.opcode == Opcode::kPing)
    client.waiting += message_of(Opcode::kPong, message.payload.data(), message.payload.size());
  if (message.opcode == Opcode::kText && message.payload == "take") give_link(client.socket);
  if (message.opcode == Opcode::kBinary && client.socket == holder_)
    stream_->write(reinterpret_cast<const uint8_t*>(message.payload.data()),
                   static_cast<uint32_t>(message.payload.size()));
}

void LiveServer::read_controller() try {
  uint8_t bytes[16384];
  const uint32_t count = stream_->read(bytes, sizeof bytes, 0);
  const auto holder = std::find_if(clients_.begin(), clients_.end(),
                                   [&](const Client& c) { return c.socket == holder_; });
  for (uint32_t i = 0; i < count; ++i) {
    decoder_.push(bytes[i]);
    link::Frame frame;
    while (decoder_.next(frame)) {
      if (holder == clients_.end() || holder->is_ending || holder->waiting.size() > kMaxWaiting)
        continue;
      uint8_t whole[link::kMaxFrameBytes];
      const uint32_t size = link::encode(frame.type, frame.sequence, frame.payload, whole);
      holder->waiting += message_of(Opcode::kBinary, whole, size);
    }
  }
  if (decoder_.rejects() == rejects_) return;
  rejects_ = decoder_.rejects();
  if (holder != clients_.end()) send_text(*holder, "rejects " + std::to_string(rejects_));
} catch (const Refused& refused) {
  for (Client& client : clients_) {
    if (client.is_page) send_text(client, std::string("closed ") + refused.what());
    write(client);
  }
  throw;
}

void LiveServer::send_text(Client& client, const std::string& text) const {
  client.waiting += message_of(Opcode::kText, text.data(), text.size());
}

void LiveServer::write(Client& client) const {
  while (!client.waiting.empty()) {
    const ssize_t count =
        ::send(client.socket, client.waiting.data(), client.waiting.size(), MSG_NOSIGNAL);
    if (count > 0) {
      client.waiting.erase(0, static_cast<size_t>(count));
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else {
      if (errno != EAGAIN) client.is_ending = true, client.waiting.clear();
      return;
    }
  }
}

}  // namespace firmtouch::host_sim
