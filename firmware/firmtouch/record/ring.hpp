#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::record {

/// A record and its number among all that were produced, dropped ones counted: a jump of more than
/// one says that, and how many, records are missing just before it. Wraps after 2^32.
template <class T>
struct Numbered {
  uint32_t number = 0;
  T value{};
};

/// Streams records from one producer (the servo interrupt, a thread) to one consumer (the main
/// loop, another thread). Lock-free; the producer never waits: where the ring is full the new
/// record is dropped and counted. At every moment produced == consumed + waiting + dropped.
///
/// Two indices that only rise (modulo 2^32), each written by one side alone: `kept_` by the
/// producer, `taken_` by the consumer; their difference is the number waiting, so full and empty
/// need no flag and no spare slot. A slot belongs to the producer until kept_ passes it and to the
/// consumer until taken_ passes it.
///
/// Memory order, and why. On one core the interrupt sees its own program order and all that is
/// needed is that the compiler keeps it; between cores, and towards DMA, the same marks become the
/// barriers:
///   kept_   release store: the slot is written before the index says so.
///           acquire load:  the slot is read after the index said so.
///   taken_  release store: the slot has been read before it is given back.
///           acquire load:  the slot is overwritten after it was given back.
///   dropped_ and a side's loads of its own index: relaxed; nothing else hangs on them.
/// tests/record/ring.pml is a model of these steps with store buffers and early loads; each of the
/// four marks is shown to be needed there. (DMA from cached memory: the board cleans the lines of
/// what ready() shows before it starts the transfer; slots begin at a line.)
/// Compiler builtins, since a freestanding toolchain need not have <atomic>; 32 bits are lock-free
/// on every target.
///
/// `LineBytes`: each side's words and the slots begin at a multiple of it, so that no line is
/// written by both sides: it would travel between the cores with every record. 64 B on the hosts, 32
/// B on a Cortex-M7; where both sides share a core 4 saves the padding.
template <class T, uint32_t Capacity, uint32_t LineBytes = 64>
class Ring {
  static_assert(__is_trivially_copyable(T), "records are copied as bytes");
  static_assert(Capacity >= 1 && (Capacity & (Capacity - 1)) == 0,
                "a power of two: the slot is a mask of the index");
  static_assert(Capacity <= 1u << 30,
                "the difference of two wrapping indices must not be ambiguous");
  static_assert(__atomic_always_lock_free(sizeof(uint32_t), nullptr), "an index is one bus access");

 public:
  static constexpr uint32_t kCapacity = Capacity;

  /// Empty. The first record gets the number `first`.
  constexpr explicit Ring(uint32_t first = 0) : kept_(first), taken_seen_(first), taken_(first) {}

  /// Producer. Keeps a copy of `value`, or drops it where the ring is full.
  /// Bounds: wait-free: a few instructions and one copy, whatever the reader does: with
  /// a tick's record 74 instructions on a Cortex-M7, 19 where it is dropped
  /// (tools/bench/ring-cortex-m7). Interrupt-safe.
  /// Result: false where it was dropped.
  bool push(const T& value) {
    const uint32_t kept = __atomic_load_n(&kept_, __ATOMIC_RELAXED);
    const uint32_t dropped = __atomic_load_n(&dropped_, __ATOMIC_RELAXED);
    if (kept - taken_seen_ >= Capacity) taken_seen_ = __atomic_load_n(&taken_, __ATOMIC_ACQUIRE);
    if (kept - taken_seen_ >= Capacity) {
      __atomic_store_n(&dropped_, dropped + 1, __ATOMIC_RELAXED);
      return false;
    }
    Numbered<T>& slot = slots_[kept & (Capacity - 1)];
    slot.number = kept + dropped;
    copy(value, slot.value);
    __atomic_store_n(&kept_, kept + 1, __ATOMIC_RELEASE);
    return true;
  }

  /// Consumer. The records that wait and lie together in memory, oldest first, to be read in place
  /// (or sent by DMA); they stay until release(). What wraps round comes with the next call.
  /// Bounds: wait-free.
  core::Span<const Numbered<T>> ready() const {
    const uint32_t taken = __atomic_load_n(&taken_, __ATOMIC_RELAXED);
    const uint32_t waiting = __atomic_load_n(&kept_, __ATOMIC_ACQUIRE) - taken;
    const uint32_t first = taken & (Capacity - 1);
    const uint32_t together = Capacity - first;
    return {slots_ + first, waiting < together ? waiting : together};
  }

  /// Consumer. Gives back the oldest `count` of the records that ready() showed.
  /// Pre: count <= ready().size().
  void release(uint32_t count) {
    const uint32_t taken = __atomic_load_n(&taken_, __ATOMIC_RELAXED);
    __atomic_store_n(&taken_, taken + count, __ATOMIC_RELEASE);
  }

  /// Consumer. Copies up to to.size() of the oldest records and gives them back.
  /// Bounds: O(records copied); a batch costs two barriers, or four where it wraps.
  /// Result: how many.
  uint32_t pop(core::Span<Numbered<T>> to) {
    uint32_t copied = 0;
    for (uint32_t part = 0; part < 2 && copied < to.size(); ++part) {
      const core::Span<const Numbered<T>> from = ready();
      const uint32_t room = to.size() - copied;
      const uint32_t count = from.size() < room ? from.size() : room;
      if (count == 0) break;
      for (uint32_t i = 0; i < count; ++i) to[copied + i] = from[i];
      release(count);
      copied += count;
    }
    return copied;
  }

  /// Any context: a moment's value. With both sides at rest, produced() == consumed() + waiting() +
  /// dropped().
  uint32_t produced() const { return __atomic_load_n(&kept_, __ATOMIC_RELAXED) + dropped(); }
  uint32_t consumed() const { return __atomic_load_n(&taken_, __ATOMIC_RELAXED); }
  uint32_t dropped() const { return __atomic_load_n(&dropped_, __ATOMIC_RELAXED); }
  uint32_t waiting() const {
    // taken_ first: the other order could see the consumer overtake an old kept_.
    const uint32_t taken = __atomic_load_n(&taken_, __ATOMIC_ACQUIRE);
    return __atomic_load_n(&kept_, __ATOMIC_ACQUIRE) - taken;
  }

 private:
  // In blocks that a compiler turns into a few wide moves. For a whole record it calls memcpy, or
  // takes a string instruction, whose start alone costs as much (measured: a third of push() on
  // x86-64, half of it on a Cortex-M7).
  static void copy(const T& from, T& to) {
    constexpr uint32_t kBlock = 16;
    const auto* in = reinterpret_cast<const uint8_t*>(&from);
    auto* out = reinterpret_cast<uint8_t*>(&to);
    for (uint32_t at = 0; at + kBlock <= sizeof(T); at += kBlock)
      __builtin_memcpy(out + at, in + at, kBlock);
    constexpr uint32_t kRest = sizeof(T) % kBlock;
    if constexpr (kRest != 0)
      __builtin_memcpy(out + sizeof(T) - kRest, in + sizeof(T) - kRest, kRest);
  }

  alignas(LineBytes) uint32_t kept_;
  uint32_t dropped_ = 0;
  // The producer's last view of taken_, refreshed only when the ring looks full.
  uint32_t taken_seen_;
  alignas(LineBytes) uint32_t taken_;
  alignas(LineBytes) Numbered<T> slots_[Capacity];
};

}  // namespace firmtouch::record
