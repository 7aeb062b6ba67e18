#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "firmtouch/link/decoder.hpp"
#include "firmtouch/link/protocol.hpp"
#include "host_sim/controllers/byte_stream.hpp"
#include "log/schema.hpp"

namespace firmtouch::host_sim {

/// A controller that runs by itself, as a recorder hears it. What its records are it tells itself,
/// so it may be of other sources than this program, if only its protocol is ours.
class LiveLink {
 public:
  explicit LiveLink(std::unique_ptr<ByteStream> stream) : stream_(std::move(stream)) {}

  /// Asks what its records, bits and parameters are. Throws Refused where it does not answer.
  void describe();
  const log::Header& header() const { return header_; }
  /// In the order of its table.
  const std::vector<link::Description>& parameters() const { return parameters_; }

  /// Begins the stream of every `decimation`-th record; the servo starts, if it did not run.
  void begin(uint32_t decimation);
  const link::HelloReply& reply() const { return reply_; }

  void set_parameter(uint32_t index, float value);
  /// Hands over what comes within `timeout_ms`: Log, Ack and Text frames. Result: how many bytes
  /// came.
  uint32_t poll(int timeout_ms, const std::function<void(const link::Frame&)>& take);
  uint32_t rejects() const { return decoder_.rejects(); }
  void leave();

 private:
  template <class T>
  void send(uint8_t type, const T& payload);
  link::Description row(uint16_t what, uint16_t index);
  link::HelloReply hello(const link::Hello& hello);
  [[noreturn]] void refuse(const std::string& what) const;

  std::unique_ptr<ByteStream> stream_;
  link::Decoder decoder_;
  link::HelloReply reply_;
  log::Header header_;
  std::vector<link::Description> parameters_;
  uint16_t sequence_ = 0;
};

/// A text of a Description, whose zeros may be missing.
template <size_t N>
std::string text_in(const char (&place)[N]) {
  size_t length = 0;
  while (length < N && place[length] != 0) ++length;
  return {place, length};
}

}  // namespace firmtouch::host_sim
