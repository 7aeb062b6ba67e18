// The live page's server over real sockets: who gets the page, who holds the link, what a message
// holds.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "firmtouch/link/frame.hpp"
#include "firmtouch/link/protocol.hpp"
#include "harness/test.hpp"
#include "host_sim/live/live_server.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace host_sim = firmtouch::host_sim;
namespace link_ = firmtouch::link;
using host_sim::ByteStream;
using host_sim::LiveServer;

namespace {

// A server with a controller's end of the link in this test's hand.
struct Served {
  explicit Served(const std::string& page = "<html>the page</html>") {
    int ends[2];
    CHECK_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    controller = ends[0];
    for (port = static_cast<uint16_t>(30000 + ::getpid() % 20000); server == nullptr; ++port) try {
        server = std::make_unique<LiveServer>(
            port, page, std::make_unique<ByteStream>(ends[1], ends[1], "controller"));
      } catch (const host_sim::Refused&) {
        CHECK_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
        controller = ends[0];
      }
    --port;
  }
  ~Served() {
    if (controller >= 0) ::close(controller);
  }
  void turn() {
    for (int i = 0; i < 6; ++i) server->poll(10);
  }
  std::unique_ptr<LiveServer> server;
  uint16_t port = 0;
  int controller = -1;
};

class Browser {
 public:
  explicit Browser(Served& served) : served_(served) {
    socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(served.port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    CHECK_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;
  ~Browser() { ::close(socket_); }

  // Sends, lets the server turn, and returns all that came.
  std::string send(const std::string& bytes) {
    CHECK_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
             static_cast<ssize_t>(bytes.size()));
    return receive();
  }
  std::string receive() {
    served_.turn();
    std::string all;
    char bytes[4096];
    for (pollfd ready{socket_, POLLIN, 0}; ::poll(&ready, 1, 0) > 0;) {
      const ssize_t count = ::read(socket_, bytes, sizeof bytes);
      if (count <= 0) return all + "<closed>";
      all.append(bytes, static_cast<size_t>(count));
    }
    return all;
  }
  void send_no_more() const { CHECK_EQ(::shutdown(socket_, SHUT_WR), 0); }
  std::string get(const std::string& path, const std::string& host, const std::string& more = "") {
    return send("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n");
  }
  std::string own() const { return "127.0.0.1:" + std::to_string(served_.port); }
  // The handshake, with the key of RFC 6455's example.
  std::string upgrade(const std::string& origin) {
    return get("/link", own(),
               "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nOrigin: " +
                   origin + "\r\n");
  }
  std::string page() { return upgrade("http://" + own()); }

 private:
  Served& served_;
  int socket_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A masked frame of a browser; `opcode` 1: text, 2: binary.
std::string masked(int opcode, const std::string& payload) {
  const char mask[] = {0x11, 0x22, 0x33, 0x44};
  std::string frame{static_cast<char>(0x80 | opcode), static_cast<char>(0x80 | payload.size())};
  frame.append(mask, 4);
  for (size_t i = 0; i < payload.size(); ++i) frame += static_cast<char>(payload[i] ^ mask[i % 4]);
  return frame;
}

std::vector<uint8_t> a_frame() {
  link_::Ack ack;
  uint8_t bytes[link_::kMaxFrameBytes];
  const uint32_t count = link_::encode(link_::kAck, 7, link_::bytes_of(ack), bytes);
  return {bytes, bytes + count};
}

}  // namespace

TEST(LiveServer_OwnName_GetsThePage) {
  Served served;
  CHECK(has(Browser(served).get("/", Browser(served).own()), "the page"));
  CHECK(has(Browser(served).get("/", "localhost:" + std::to_string(served.port)), "the page"));
  CHECK(has(Browser(served).get("/other", Browser(served).own()), "404"));
}

TEST(LiveServer_SlowBrowserThatSendsNoMore_GetsTheWholePage) {
  const std::string page(32u << 20, 'p');  // more than the sockets hold
  Served served(page);
  Browser browser(served);
  std::string all = browser.get("/", browser.own());
  CHECK(all.size() < page.size());
  browser.send_no_more();
  for (int i = 0; i < 100 && !has(all, "<closed>"); ++i) all += browser.receive();
  CHECK(has(all, page + "<closed>"));
}

TEST(LiveServer_ForeignNameOrOrigin_IsRefused) {
  Served served;
  const std::string refused = "403 Forbidden";
  CHECK(has(Browser(served).get("/", "evil.example:" + std::to_string(served.port)), refused));
  CHECK(has(Browser(served).get("/", "127.0.0.1"), refused));
  CHECK(has(Browser(served).upgrade("http://evil.example"), refused));
  CHECK(has(Browser(served).upgrade("null"), refused));
  CHECK(has(Browser(served).upgrade("https://127.0.0.1:" + std::to_string(served.port)), refused));
}

TEST(LiveServer_Handshake_AnswersAsTheStandardsExample) {
  Served served;
  const std::string answer = Browser(served).page();
  CHECK(has(answer, "101 Switching Protocols"));
  CHECK(has(answer, "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n"));
}

TEST(LiveServer_OneMessageAFrame_HoweverTheBytesCome) {
  Served served;
  Browser browser(served);
  browser.page();
  const std::vector<uint8_t> frame = a_frame();
  std::string expected{static_cast<char>(0x82), static_cast<char>(frame.size())};
  expected.append(frame.begin(), frame.end());
  for (const uint8_t byte : frame) {  // byte by byte
    CHECK_EQ(::write(served.controller, &byte, 1), 1);
    served.turn();
  }
  CHECK(browser.receive() == expected);
  std::vector<uint8_t> two = frame;
  two.insert(two.end(), frame.begin(), frame.end());
  CHECK_EQ(::write(served.controller, two.data(), two.size()), static_cast<ssize_t>(two.size()));
  CHECK(browser.receive() == expected + expected);
}

TEST(LiveServer_SecondPage_WaitsAndTakesOver) {
  Served served;
  Browser first(served), second(served);
  CHECK(has(first.page(), "yours"));
  CHECK(has(second.page(), "held"));
  second.send(masked(2, "from the second"));
  char bytes[64];
  CHECK(::recv(served.controller, bytes, sizeof bytes, MSG_DONTWAIT) < 0);
  first.send(masked(2, "first"));
  CHECK_EQ(::recv(served.controller, bytes, sizeof bytes, MSG_DONTWAIT), 5);
  CHECK(has(second.send(masked(1, "take")), "yours"));
  CHECK(has(first.receive(), "held"));
  second.send(masked(2, "second"));
  CHECK_EQ(::recv(served.controller, bytes, sizeof bytes, MSG_DONTWAIT), 6);
  second.send(masked(8, ""));  // leaves
  CHECK(has(first.receive(), "yours"));
}

TEST(LiveServer_LostController_IsReportedToThePage) {
  Served served;
  Browser browser(served);
  browser.page();
  ::close(served.controller);
  served.controller = -1;
  std::string message;
  try {
    served.turn();
  } catch (const host_sim::Refused& refused) {
    message = refused.what();
  }
  CHECK(has(message, "closed the link"));
}

TEST(LiveServer_HostileBytes_EndTheirConnectionOnly) {
  Served served;
  Browser good(served);
  good.page();
  const std::string unmasked{static_cast<char>(0x82), 1, 'x'};
  const std::string huge = std::string{static_cast<char>(0x82), static_cast<char>(0xFF)} +
                           std::string(8, static_cast<char>(0x7F));
  for (const std::string& bytes : {unmasked, huge, std::string("\x02\x81mask!", 7)}) {
    Browser bad(served);
    bad.page();
    CHECK(has(bad.send(bytes), "<closed>"));
  }
  const std::string long_head = Browser(served).send(std::string(20000, 'A'));
  CHECK(has(long_head, "431 ") && has(long_head, "16384 bytes") && has(long_head, "<closed>"));
  CHECK(has(Browser(served).send("POST / HTTP/1.1\r\n\r\n"), "405"));
  CHECK(!has(good.send(masked(9, "ping")), "<closed>"));
}
