#include "firmtouch/link/frame.hpp"

#include "firmtouch/core/crc32.hpp"
#include "firmtouch/link/decoder.hpp"
#include "firmtouch/link/protocol.hpp"
#include "harness/test.hpp"
#include "link/stream.hpp"

namespace firmtouch::link {
namespace {

using namespace test;  // NOLINT: a test file

void ignore(const Frame&) {}

struct Payload {
  explicit Payload(uint32_t seed) {
    Random random(seed);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random.next() & 0xFFu);
  }
  uint8_t bytes[kMaxPayloadBytes + 1];
  core::Bytes first(uint32_t count) const { return {bytes, count}; }
};

void check_finds_only(Decoder& decoder, const Wire& wire, uint16_t sequence) {
  const uint32_t found = feed(decoder, {wire.bytes, wire.count}, [sequence](const Frame& frame) {
    CHECK_EQ(frame.sequence, sequence);
  });
  CHECK_EQ(found, 1u);
}

TEST(Frame_EveryLength_RoundTrips) {
  const Payload payload(1);
  Decoder decoder;
  for (uint32_t length = 0; length <= kMaxPayloadBytes; ++length) {
    firmtouch::test::note("length", length);
    Wire wire;
    CHECK_EQ(wire.frame(kLog, static_cast<uint16_t>(length * 257), payload.first(length)),
             kHeaderBytes + length + kCrcBytes);
    const uint32_t found = feed(decoder, {wire.bytes, wire.count}, [&](const Frame& frame) {
      CHECK_EQ(frame.type, kLog);
      CHECK_EQ(frame.sequence, static_cast<uint16_t>(length * 257));
      CHECK(same(frame.payload, payload.first(length)));
    });
    CHECK_EQ(found, 1u);
  }
  CHECK_EQ(decoder.rejects(), 0u);
  CHECK_EQ(decoder.skipped_bytes(), 0u);
}

TEST(Frame_Bytes_MatchTheDocumentedLayout) {
  const uint8_t payload[2] = {0x11, 0x22};
  uint8_t out[14] = {};
  CHECK_EQ(encode(0x42, 0x0304, payload, out), 14u);
  const uint8_t head[7] = {0xF7, 0x5A, 0x04, 0x03, 0x02, 0x00, 0x42};
  for (uint32_t i = 0; i < 7; ++i) CHECK_EQ(out[i], head[i]);
  CHECK_EQ(out[7], core::crc32({out, 7}) & 0xFFu);
  CHECK_EQ(out[8], 0x11);
  CHECK_EQ(out[9], 0x22);
  // A CRC-32 over a message and its own CRC leaves a constant: an oracle that shares no byte order
  // with encode().
  CHECK_EQ(core::crc32(out), 0x2144DF1Cu);
}

TEST(Encode_TooLarge_WritesNothing) {
  const Payload payload(2);
  uint8_t out[kMaxFrameBytes + 8];
  for (uint8_t& byte : out) byte = 0xEE;
  CHECK_EQ(encode(kText, 0, payload.first(kMaxPayloadBytes + 1), out), 0u);
  CHECK_EQ(encode(kText, 0, payload.first(5), {out, kHeaderBytes + 5 + kCrcBytes - 1}), 0u);
  CHECK_EQ(encode(kText, 0, {}, {out, 0}), 0u);
  for (const uint8_t byte : out) CHECK_EQ(byte, 0xEE);
  CHECK_EQ(encode(kText, 0, payload.first(5), {out, kHeaderBytes + 5 + kCrcBytes}),
           kHeaderBytes + 5 + kCrcBytes);
}

TEST(Decoder_GarbageBeforeFrame_IsSkippedAndCounted) {
  for (uint32_t seed = 1; seed <= 200; ++seed) {
    firmtouch::test::note("seed", seed);
    Random random(seed);
    const Payload payload(seed);
    Wire wire;
    const uint32_t garbage = random.below(400);
    for (uint32_t i = 0; i < garbage; ++i) wire.byte(static_cast<uint8_t>(random.next() & 0xFFu));
    const uint32_t length = random.below(kMaxPayloadBytes + 1);
    wire.frame(kStep, 7, payload.first(length));
    Decoder decoder;
    const uint32_t found = feed(decoder, {wire.bytes, wire.count}, [&](const Frame& frame) {
      CHECK(same(frame.payload, payload.first(length)));
    });
    CHECK_EQ(found, 1u);
    CHECK_EQ(decoder.skipped_bytes(), garbage);
  }
}

TEST(Decoder_FalseSync_DoesNotHideLaterFrames) {
  const Payload payload(3);
  Wire wire;
  wire.frame(kLog, 1, payload.first(200));
  wire.count = 60;  // cut off in the middle: its length still promises 152 bytes
  wire.frame(kStep, 2, payload.first(32));
  wire.frame(kStep, 3, payload.first(32));
  wire.frame(kStep, 4, payload.first(100));
  Decoder decoder;
  uint16_t next = 2;
  const uint32_t found = feed(decoder, {wire.bytes, wire.count},
                              [&](const Frame& frame) { CHECK_EQ(frame.sequence, next++); });
  CHECK_EQ(found, 3u);
  CHECK_EQ(decoder.rejects(), 1u);
  CHECK_EQ(decoder.skipped_bytes(), 60u);
}

TEST(Decoder_DamagedLength_IsRejectedAtOnce) {
  const Payload payload(4);
  for (uint32_t bit = 0; bit < 16; ++bit) {
    firmtouch::test::note("bit", bit);
    Wire wire;
    wire.frame(kStep, 1, payload.first(32));
    wire.bytes[4 + bit / 8] = static_cast<uint8_t>(wire.bytes[4 + bit / 8] ^ (1u << (bit % 8)));
    wire.frame(kStep, 2, payload.first(32));
    Decoder decoder;
    check_finds_only(decoder, wire, 2);
    CHECK_GE(decoder.rejects(), 1u);
  }
}

TEST(Decoder_LengthBeyondBuffer_IsRejected) {
  Wire wire;
  const uint8_t header[7] = {0xF7, 0x5A, 0, 0, 0xF5, 0, kText};  // 245: one more than fits
  for (const uint8_t byte : header) wire.byte(byte);
  wire.byte(static_cast<uint8_t>(core::crc32({wire.bytes, 7}) & 0xFFu));
  wire.frame(kBye, 9, {});
  Decoder decoder;
  check_finds_only(decoder, wire, 9);
  CHECK_EQ(decoder.rejects(), 1u);
}

TEST(Decoder_EverySingleAndDoubleBitError_IsRejected) {
  const Payload payload(5);
  Wire clean;
  clean.frame(kAck, 0x5AF7, payload.first(8));
  const uint32_t bits = clean.count * 8;
  for (uint32_t a = 0; a < bits; ++a) {
    for (uint32_t b = a; b < bits; ++b) {  // b == a: the single error
      Wire wire = clean;
      wire.bytes[a / 8] = static_cast<uint8_t>(wire.bytes[a / 8] ^ (1u << (a % 8)));
      if (b != a) wire.bytes[b / 8] = static_cast<uint8_t>(wire.bytes[b / 8] ^ (1u << (b % 8)));
      Decoder decoder;
      firmtouch::test::note("bits", a * 1000 + b);
      const uint32_t found = feed(decoder, {wire.bytes, wire.count}, ignore);
      CHECK_EQ(found, 0u);
    }
  }
}

TEST(Decoder_StreamOfSyncs_LosesNoFrame) {
  Decoder decoder;
  const Payload payload(6);
  for (uint32_t i = 0; i < 2000; ++i) {
    const uint8_t byte = i % 2 == 0 ? 0xF7 : 0x5A;
    CHECK(decoder.push(byte));
    Frame frame;
    CHECK(!decoder.next(frame));
  }
  Wire wire;
  wire.frame(kStep, 1, payload.first(32));
  const uint32_t found = feed(decoder, {wire.bytes, wire.count}, ignore);
  CHECK_EQ(found, 1u);
}

TEST(Decoder_PushIntoFullBuffer_IsRejected) {
  Decoder decoder;
  for (uint32_t i = 0; i < kMaxFrameBytes; ++i) CHECK(decoder.push(0));
  CHECK(!decoder.push(0));
  Frame frame;
  CHECK(!decoder.next(frame));
  CHECK(decoder.push(0));
}

TEST(Take_OtherLength_Fails) {
  const SetParam sent{3, 2.5f};
  Frame frame;
  frame.payload = bytes_of(sent);
  SetParam got;
  CHECK(take(frame, got));
  CHECK_EQ(got.index, 3u);
  CHECK_EQ(got.value, 2.5f);
  frame.payload = {frame.payload.data(), 7};
  got = {};
  CHECK(!take(frame, got));
  CHECK_EQ(got.index, 0u);
}

}  // namespace
}  // namespace firmtouch::link
