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

/// Link to a free-running controller, for recording. The controller describes its own records, so
/// it may be of another release as long as the protocol is the same.
class LiveLink {
 public:
  explicit LiveLink(std::unique_ptr<ByteStream> stream) : stream_(std::move(stream)) {}

  /// Reads the descriptions of records, bits and parameters. Throws Refused without an answer.
  void describe();
  const log::Header& header() const { return header_; }
  /// In the order of its table.
  const std::vector<link::Description>& parameters() const { return parameters_; }

  /// What the controller's last run left. Throws Refused if its program keeps no crash record.
  link::CrashReply read_crash();

  /// One request of an update (link/protocol.hpp), and its answer. Throws Refused if the program
  /// takes no assets.
  link::AssetAck begin_asset(uint32_t bytes, uint32_t crc);
  link::AssetAck send_asset_block(core::Bytes asset, uint32_t offset);
  link::AssetAck commit_asset();

  /// Starts the stream of every `decimation`-th record; starts the servo if it does not run.
  void begin(uint32_t decimation);
  const link::HelloReply& reply() const { return reply_; }

  void set_parameter(uint32_t index, float value);
  /// Waits up to `timeout_ms` and passes each received frame (Log, Ack, Text) to `take`.
  /// Result: number of bytes received.
  uint32_t poll(int timeout_ms, const std::function<void(const link::Frame&)>& take);
  uint32_t rejects() const { return decoder_.rejects(); }
  void leave();

 private:
  template <class T>
  void send(uint8_t type, const T& payload);
  void exchange(const char* what, const std::function<void()>& send_request,
                const std::function<bool(const link::Frame&)>& is_reply);
  link::Description row(uint16_t what, uint16_t index);
  template <class T>
  link::AssetAck update(uint8_t type, const T& payload);
  link::HelloReply hello(const link::Hello& hello);
  [[noreturn]] void refuse(const std::string& what) const;

  std::unique_ptr<ByteStream> stream_;
  link::Decoder decoder_;
  link::HelloReply reply_;
  log::Header header_;
  std::vector<link::Description> parameters_;
  uint16_t sequence_ = 0;
  bool is_proving_ = false;  // the controller, its asset
};

/// Text of a fixed-size field, with or without a final zero.
template <size_t N>
std::string text_in(const char (&field)[N]) {
  size_t length = 0;
  while (length < N && field[length] != 0) ++length;
  return {field, length};
}

}  // namespace firmtouch::host_sim
