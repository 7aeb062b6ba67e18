#pragma once
#include <cstdint>
#include <string>

namespace firmtouch::host_sim {

/// Head of an HTTP request.
struct Request {
  std::string path;
  std::string host, origin, upgrade, key;  // empty: not given
};

/// Parses the head that ends with an empty line. Result: false if it is not a GET request.
bool parse_request(const std::string& head, Request& request);

/// Answer to the Sec-WebSocket-Key `key`. Source: RFC 6455, section 1.3.
std::string accept_of(const std::string& key);

enum class Opcode : uint8_t { kText = 1, kBinary = 2, kClose = 8, kPing = 9, kPong = 10 };

/// One message to a browser, in one frame. Source: RFC 6455, section 5.2.
std::string message_of(Opcode opcode, const void* payload, size_t bytes);

struct Message {
  Opcode opcode = Opcode::kClose;
  std::string payload;
};

enum class Taken { kNone, kOne, kBroken };

/// Takes the first whole message off `received`. A browser masks its frames and sends short ones; a
/// frame that is not masked, is split or has more than 64 kB is broken.
Taken take_message(std::string& received, Message& message);

}  // namespace firmtouch::host_sim
