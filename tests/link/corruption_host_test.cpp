#include <cstdlib>

#include "firmtouch/link/decoder.hpp"
#include "harness/test.hpp"
#include "link/stream.hpp"

namespace firmtouch::link {
namespace {

using namespace test;  // NOLINT: a test file

constexpr uint32_t kFrames = 2;

struct Sent {
  uint8_t payload[48];
  uint32_t length;
  uint8_t type;
  uint16_t sequence;
};

void flip_bits(Random& random, Wire& wire, uint32_t from, uint32_t to) {
  const uint32_t flips = 1 + random.below(16);
  for (uint32_t i = 0; i < flips; ++i) {
    const uint32_t bit = from * 8 + random.below((to - from) * 8);
    wire.bytes[bit / 8] = static_cast<uint8_t>(wire.bytes[bit / 8] ^ (1u << (bit % 8)));
  }
}

void remove(Wire& wire, uint32_t from, uint32_t count) {
  for (uint32_t i = from + count; i < wire.count; ++i) wire.bytes[i - count] = wire.bytes[i];
  wire.count -= count;
}

// Flipped bits, truncation, lost bytes (which splices frames), overwritten bytes, repeated bytes.
void damage(Random& random, Wire& wire) {
  switch (random.below(5)) {
    case 0:
      return flip_bits(random, wire, 0, wire.count);
    case 1:
      wire.count = random.below(wire.count);
      return;
    case 2: {
      const uint32_t from = random.below(wire.count);
      return remove(wire, from, 1 + random.below(wire.count - from));
    }
    case 3: {
      const uint32_t from = random.below(wire.count);
      const uint32_t count = 1 + random.below(wire.count - from);
      for (uint32_t i = 0; i < count; ++i)
        wire.bytes[from + i] = static_cast<uint8_t>(random.next() & 0xFFu);
      return;
    }
    default: {
      const uint32_t from = random.below(wire.count);
      const uint32_t count = 1 + random.below(wire.count - from);
      Wire doubled = wire;
      for (uint32_t i = 0; i < wire.count - from; ++i)
        doubled.bytes[from + count + i] = wire.bytes[from + i];
      doubled.count += count;
      wire = doubled;
      return;
    }
  }
}

bool was_sent(const Frame& frame, const Sent (&sent)[kFrames]) {
  for (const Sent& one : sent) {
    if (frame.type == one.type && frame.sequence == one.sequence &&
        same(frame.payload, {one.payload, one.length})) {
      return true;
    }
  }
  return false;
}

TEST(Decoder_DamagedStream_ReturnsOnlySentFrames) {
  const uint32_t tries = std::getenv("FIRMTOUCH_LONG") != nullptr ? 100000000 : 200000;
  Random random(20260101);
  const uint8_t silence[kMaxFrameBytes] = {};
  uint32_t accepted = 0;
  uint32_t given = 0;
  for (uint32_t i = 0; i < tries; ++i) {
    Sent sent[kFrames];
    Wire wire;
    for (Sent& one : sent) {
      one.length = random.below(sizeof one.payload + 1);
      for (uint32_t k = 0; k < one.length; ++k) {
        one.payload[k] = static_cast<uint8_t>(random.next() & 0xFFu);
      }
      one.type = static_cast<uint8_t>(random.next() & 0xFFu);
      one.sequence = static_cast<uint16_t>(random.next() & 0xFFFFu);
      wire.frame(one.type, one.sequence, {one.payload, one.length});
    }
    damage(random, wire);
    const auto check_stream = [&](const Frame& frame) {
      if (!was_sent(frame, sent)) ++accepted;
    };
    Decoder decoder;
    given += feed(decoder, {wire.bytes, wire.count}, check_stream);
    given += feed(decoder, silence,
                  check_stream);  // completes a frame whose length is false
  }
  CHECK_EQ(accepted, 0u);
  CHECK_GE(given, tries / 4);  // the undamaged neighbours got through
  CHECK_LT(given, 2 * tries);
}

}  // namespace
}  // namespace firmtouch::link
