#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

namespace firmtouch::record {

/// A record and its number among all produced ones, dropped ones included: a gap in the numbers is
/// the number of records missing before it. Wraps after 2^32.
template <class T>
struct Numbered {
  uint32_t number = 0;
  T value{};
};

/// Single-producer, single-consumer ring of records, e.g. from the servo interrupt to the main
/// loop. Lock-free; the producer never waits: if the ring is full, the new record is dropped and
/// counted. Always produced == consumed + waiting + dropped.
///
/// Two indices increase modulo 2^32. The producer writes `kept_`, the consumer `taken_`; their
/// difference is the number of waiting records, so no slot is wasted. A slot belongs to the
/// producer until kept_ passes it, then to the consumer until taken_ passes it.
///
/// Memory order. On one core it only stops the compiler from reordering; between cores, and towards
/// DMA, it becomes the barriers:
///   kept_   release store: the slot is written before the index is.
///           acquire load:  the slot is read after the index was.
///   taken_  release store: the slot was read before it is given back.
///           acquire load:  the slot is overwritten after it was given back.
///   dropped_, and each side's loads of its own index: relaxed.
/// Model: tests/record/ring.pml shows that each of the four is needed.
/// Compiler builtins, because a freestanding toolchain may lack <atomic>.
///
/// `LineBytes`: alignment of each side's words and of the slots, so that the two sides never write
/// the same cache line. 64 B on hosts, 32 B on a Cortex-M7; 4 if both sides share a core.
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

  /// Producer. Appends a copy of `value`, or drops it if the ring is full.
  /// Bounds: wait-free; interrupt-safe. A tick's record takes 85 instructions on a Cortex-M7, 18
  /// instructions if it is dropped.
  /// Result: false if it was dropped.
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

  /// Consumer. The waiting records up to the end of the buffer, oldest first, to be read in place
  /// or sent by DMA. They stay until release(); those after the wrap come with the next call. For
  /// DMA from cached memory the board cleans their cache lines first. Bounds: wait-free.
  core::Span<const Numbered<T>> ready() const {
    const uint32_t taken = __atomic_load_n(&taken_, __ATOMIC_RELAXED);
    const uint32_t waiting = __atomic_load_n(&kept_, __ATOMIC_ACQUIRE) - taken;
    const uint32_t first = taken & (Capacity - 1);
    const uint32_t together = Capacity - first;
    return {slots_ + first, waiting < together ? waiting : together};
  }

  /// Consumer. Gives back the oldest `count` records of ready().
  /// Pre: count <= ready().size().
  void release(uint32_t count) {
    const uint32_t taken = __atomic_load_n(&taken_, __ATOMIC_RELAXED);
    __atomic_store_n(&taken_, taken + count, __ATOMIC_RELEASE);
  }

  /// Consumer. Copies up to to.size() of the oldest records and gives them back.
  /// Bounds: O(records copied); two barriers a batch, four if it wraps.
  /// Result: number of records copied.
  uint32_t pop(core::Span<Numbered<T>> to) {
    uint32_t copied = 0;
    for (uint32_t batch = 0; batch < 2 && copied < to.size(); ++batch) {
      const core::Span<const Numbered<T>> from = ready();
      const uint32_t space = to.size() - copied;
      const uint32_t count = from.size() < space ? from.size() : space;
      if (count == 0) break;
      for (uint32_t i = 0; i < count; ++i) to[copied + i] = from[i];
      release(count);
      copied += count;
    }
    return copied;
  }

  /// Any context: a snapshot. With both sides at rest, produced() == consumed() + waiting() +
  /// dropped().
  uint32_t produced() const { return __atomic_load_n(&kept_, __ATOMIC_RELAXED) + dropped(); }
  uint32_t consumed() const { return __atomic_load_n(&taken_, __ATOMIC_RELAXED); }
  uint32_t dropped() const { return __atomic_load_n(&dropped_, __ATOMIC_RELAXED); }
  uint32_t waiting() const {
    // taken_ first: otherwise the consumer could overtake an older kept_.
    const uint32_t taken = __atomic_load_n(&taken_, __ATOMIC_ACQUIRE);
    return __atomic_load_n(&kept_, __ATOMIC_ACQUIRE) - taken;
  }

 private:
  // Copies in blocks that the compiler turns into wide moves. For a whole record it would call
  // memcpy or use a string instruction, which costs a third of push() on x86-64, half on a
  // Cortex-M7.
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
