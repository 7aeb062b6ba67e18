#include "host_sim/live/web_socket.hpp"

#include <algorithm>
#include <cctype>

#include "host_sim/report/image.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr size_t kMaxPayload = 65536;

uint32_t turned(uint32_t value, int bits) { return (value << bits) | (value >> (32 - bits)); }

// SHA-1 (FIPS 180-4): the handshake needs it, nothing here relies on its strength.
std::string sha1(std::string text) {
  const uint64_t bits = uint64_t{text.size()} * 8;
  text += '\x80';
  while (text.size() % 64 != 56) text += '\0';
  for (int k = 7; k >= 0; --k) text += static_cast<char>(bits >> (8 * k) & 0xFF);
  uint32_t h[5] = {0x67452301, 0xEFCDAB89, 0x98BADCFE, 0x10325476, 0xC3D2E1F0};
  for (size_t block = 0; block < text.size(); block += 64) {
    uint32_t w[80];
    for (size_t i = 0; i < 16; ++i) {
      w[i] = 0;
      for (size_t k = 0; k < 4; ++k)
        w[i] = w[i] << 8 | static_cast<uint8_t>(text[block + 4 * i + k]);
    }
    for (size_t i = 16; i < 80; ++i) w[i] = turned(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
    uint32_t a = h[0], b = h[1], c = h[2], d = h[3], e = h[4];
    for (size_t i = 0; i < 80; ++i) {
      const uint32_t f = i < 20   ? (b & c) | (~b & d)
                         : i < 40 ? b ^ c ^ d
                         : i < 60 ? (b & c) | (b & d) | (c & d)
                                  : b ^ c ^ d;
      constexpr uint32_t kRound[] = {0x5A827999, 0x6ED9EBA1, 0x8F1BBCDC, 0xCA62C1D6};
      const uint32_t next = turned(a, 5) + f + e + kRound[i / 20] + w[i];
      e = d, d = c, c = turned(b, 30), b = a, a = next;
    }
    h[0] += a, h[1] += b, h[2] += c, h[3] += d, h[4] += e;
  }
  std::string digest;
  for (const uint32_t word : h)
    for (int k = 3; k >= 0; --k) digest += static_cast<char>(word >> (8 * k) & 0xFF);
  return digest;
}

}  // namespace

bool parse_request(const std::string& head, Request& request) {
  if (head.compare(0, 4, "GET ") != 0) return false;
  const size_t end = head.find(' ', 4);
  if (end == std::string::npos) return false;
  request.path = head.substr(4, end - 4);
  for (size_t at = head.find("\r\n"); at != std::string::npos; at = head.find("\r\n", at + 2)) {
    const size_t colon = head.find(':', at + 2), last = head.find("\r\n", at + 2);
    if (colon == std::string::npos || last == std::string::npos || colon > last) continue;
    std::string name = head.substr(at + 2, colon - at - 2);
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const size_t from = std::min(head.find_first_not_of(' ', colon + 1), last);
    const std::string value = head.substr(from, last - from);
    if (name == "host") request.host = value;
    if (name == "origin") request.origin = value;
    if (name == "upgrade") request.upgrade = value;
    if (name == "sec-websocket-key") request.key = value;
  }
  return true;
}

std::string accept_of(const std::string& key) {
  const std::string digest = sha1(key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11");
  return base64_of(digest.data(), digest.size());
}

std::string message_of(Opcode opcode, const void* payload, size_t bytes) {
  std::string frame(1, static_cast<char>(0x80u | static_cast<uint32_t>(opcode)));
  if (bytes < 126) {
    frame += static_cast<char>(bytes);
  } else {
    const int count = bytes < 65536 ? 2 : 8;
    frame += static_cast<char>(count == 2 ? 126 : 127);
    for (int k = count - 1; k >= 0; --k) frame += static_cast<char>(uint64_t{bytes} >> (8 * k));
  }
  return frame.append(static_cast<const char*>(payload), bytes);
}

Taken take_message(std::string& received, Message& message) {
  const auto byte = [&](size_t i) { return static_cast<uint8_t>(received[i]); };
  if (received.size() < 2) return Taken::kNone;
  const bool is_whole = (byte(0) & 0xF0) == 0x80, is_masked = (byte(1) & 0x80) != 0;
  size_t length = byte(1) & 0x7F, at = 2;
  if (!is_whole || !is_masked || length == 127) return Taken::kBroken;
  if (length == 126) {
    if (received.size() < 4) return Taken::kNone;
    length = size_t{byte(2)} << 8 | byte(3);
    at = 4;
  }
  if (length > kMaxPayload) return Taken::kBroken;
  if (received.size() < at + 4 + length) return Taken::kNone;
  message.opcode = static_cast<Opcode>(byte(0) & 0x0F);
  message.payload.clear();
  for (size_t i = 0; i < length; ++i)
    message.payload += static_cast<char>(byte(at + 4 + i) ^ byte(at + i % 4));
  received.erase(0, at + 4 + length);
  return Taken::kOne;
}

}  // namespace firmtouch::host_sim
