#include "host_sim/controllers/live_link.hpp"

#include <algorithm>
#include <chrono>

#include "host_sim/controllers/asset_remedy.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kAgain_ms = 1000;
constexpr uint16_t kMaxRows = 1024;

}  // namespace

void LiveLink::refuse(const std::string& what) const {
  throw Refused(stream_->name() + ": " + what);
}

template <class T>
void LiveLink::send(uint8_t type, const T& payload) {
  uint8_t bytes[link::kMaxFrameBytes];
  const uint32_t count = link::encode(type, ++sequence_, link::bytes_of(payload), bytes);
  stream_->write(bytes, count);
}

uint32_t LiveLink::poll(int timeout_ms, const std::function<void(const link::Frame&)>& take) {
  uint8_t bytes[4096];
  const uint32_t count = stream_->read(bytes, sizeof bytes, timeout_ms);
  for (uint32_t i = 0; i < count; ++i) {
    decoder_.push(bytes[i]);
    link::Frame frame;
    while (decoder_.next(frame)) take(frame);
  }
  return count;
}

// Sends a request once a second until `is_reply` accepts a frame. Throws Refused if none comes in
// the stream's time. `what`: is not answered.
void LiveLink::exchange(const char* what, const std::function<void()>& send_request,
                        const std::function<bool(const link::Frame&)>& is_reply) {
  AnswerTime time(stream_->name() + ": no answer to " + what, stream_->wait_s());
  while (!time.is_over()) {
    send_request();
    bool received = false;
    for (const auto sent = Clock::now();
         !received && !time.is_over() &&
         Clock::now() - sent < std::chrono::milliseconds(kAgain_ms);)
      poll(time.wait_ms(kAgain_ms), [&](const link::Frame& frame) { received |= is_reply(frame); });
    if (received) return;
  }
  throw Refused(time.text() + "; " +
                (is_proving_ ? "the controller is still checking its asset: wait longer"
                             : stream_->why_silent()));
}

link::Description LiveLink::row(uint16_t what, uint16_t index) {
  link::Describe query;
  query.what = what;
  query.index = index;
  link::Description row;
  exchange(
      "a query of its records", [&] { send(link::kDescribe, query); },
      [&](const link::Frame& frame) {
        link::Description reply;
        if (frame.type == link::kText)
          refuse("the controller does not describe its records: it is of another release");
        if (frame.type != link::kDescription || !link::take(frame, reply)) return false;
        if (reply.what != what || reply.index != index) return false;
        row = reply;
        return true;
      });
  return row;
}

void LiveLink::describe() {
  for (const uint16_t what : {link::kDescribeField, link::kDescribeBit, link::kDescribeParameter}) {
    for (uint16_t i = 0, rows = 1; i < rows && i < kMaxRows; ++i) {
      const link::Description found = row(what, i);
      rows = found.rows;
      if (what == link::kDescribeField) {
        log::Field field;
        field.name = text_in(found.name);
        field.unit = text_in(found.unit);
        field.scale = log::decimal_of(found.number[0]);
        field.zero = log::decimal_of(found.number[1]);
        field.type = static_cast<log::Type>(found.kind % 3);
        field.count = found.count;
        header_.fields.push_back(field);
      } else if (what == link::kDescribeBit) {
        header_.bits.push_back({text_in(found.unit), found.kind, text_in(found.name)});
      } else {
        parameters_.push_back(found);
      }
    }
  }
  header_.record_bytes = log::place(header_.fields);
}

link::CrashReply LiveLink::read_crash() {
  link::CrashReply reply;
  exchange(
      "a query of its last crash", [&] { send(link::kReadCrash, link::ReadCrash{}); },
      [&](const link::Frame& frame) {
        if (frame.type == link::kText)
          refuse("the controller keeps no crash record: build it with part `crash_record`");
        return frame.type == link::kCrashReply && link::take(frame, reply);
      });
  return reply;
}

// A reply has the sequence of its request. One that comes late, when the request was sent again, is
// no answer to the next.
template <class T>
link::AssetAck LiveLink::update(uint8_t type, const T& payload) {
  link::AssetAck ack;
  const uint16_t before = sequence_;
  exchange(
      "an update of its asset", [&] { send(type, payload); },
      [&](const link::Frame& frame) {
        if (frame.type == link::kText)
          refuse("the controller takes no assets: build it with part `asset_slots`");
        const uint16_t sent = sequence_ - before, back = frame.sequence - before;
        const bool is_ours = back > 0 && back <= sent;
        return is_ours && frame.type == link::kAssetAck && link::take(frame, ack);
      });
  return ack;
}

link::AssetAck LiveLink::begin_asset(uint32_t bytes, uint32_t crc) {
  return update(link::kBeginAsset, link::BeginAsset{link::kProtocolVersion, bytes, crc});
}

link::AssetAck LiveLink::send_asset_block(core::Bytes asset, uint32_t offset) {
  link::AssetBlock block;
  block.offset = offset;
  std::copy_n(asset.data() + offset, std::min(link::kAssetBlockBytes, asset.size() - offset),
              block.data);
  return update(link::kAssetBlock, block);
}

link::AssetAck LiveLink::commit_asset() { return update(link::kCommitAsset, link::CommitAsset{}); }

// Result: the controller's reply, after it has proven its asset.
link::HelloReply LiveLink::hello(const link::Hello& hello) {
  link::HelloReply reply;
  exchange(
      "the handshake", [&] { send(link::kHello, hello); },
      [&](const link::Frame& frame) {
        if (frame.type != link::kHelloReply || !link::take(frame, reply)) return false;
        is_proving_ = (reply.refused & link::kRefusedNotReady) != 0;
        return !is_proving_;
      });
  return reply;
}

void LiveLink::begin(uint32_t decimation) {
  link::Hello first;
  first.mode = link::kModeIdentify;
  reply_ = hello(first);
  if ((reply_.refused & (link::kRefusedProtocol | link::kRefusedAssetRejected)) != 0)
    refuse("the controller rejects the session:\n" + refusal_text(first.host, reply_));
  link::Hello second;
  second.host = reply_.controller;
  second.decimation = decimation;
  send(link::kHello, second);  // its reply precedes the first record
}

void LiveLink::set_parameter(uint32_t index, float value) {
  link::SetParam request;
  request.index = index;
  request.value = value;
  send(link::kSetParam, request);
}

void LiveLink::leave() { send(link::kBye, link::Bye{}); }

}  // namespace firmtouch::host_sim
