#pragma once
#include <stdint.h>

namespace firmtouch::core {

/// Passes requests from a fast context to a slow one, and results back through a double buffer. The
/// servo interrupt uses the last result while the next one is computed below it.
/// Bounds: wait-free on both sides, between an interrupt and what it interrupts and between
/// threads.
///
/// The state word says who owns the request and the spare result:
///   kIdle       the fast side; it may make a request.
///   kRequested  the slow side, until made(). The fast side reads the other result.
///   kMade       the fast side, which takes the result whenever it likes: the two change roles.
/// Only the owner changes the state, so a load and a store are enough. Stores release and loads
/// acquire: whatever was written before a change of state is visible after it.
/// Model: tests/core/handoff.pml shows that all four orders are needed, and that the relaxed store
/// of take() is enough. Tests: tests/core/handoff_{interrupt,threads}_host_test.cpp.
template <class Request, class Result>
class Handoff {
  static_assert(__is_trivially_copyable(Request) && __is_trivially_copyable(Result),
                "plain values: they are copied and reset as such");
  static_assert(__atomic_always_lock_free(sizeof(uint32_t), nullptr), "one bus access");

 public:
  /// Fast side. Whether it may make a request; whether a result waits to be taken.
  bool is_idle() const { return state() == kIdle; }
  bool is_made() const { return state() == kMade; }

  /// Fast side, while is_idle(): the request to fill in, and the call that hands it over.
  Request& request_draft() { return request_; }
  void request() { __atomic_store_n(&state_, kRequested, __ATOMIC_RELEASE); }

  /// Fast side: the finished result becomes result().
  /// Result: false, and result() unchanged, unless is_made().
  bool take() {
    if (state() != kMade) return false;
    current_ ^= 1u;
    __atomic_store_n(&state_, kIdle, __ATOMIC_RELAXED);  // relaxed: the fast side owns the state
    return true;
  }

  /// Fast side: the result taken last. The slow side never writes to it.
  const Result& result() const { return results_[current_]; }
  Result& result() { return results_[current_]; }

  /// Slow side.
  /// Result: the pending request; null if there is none.
  const Request* requested() const { return state() == kRequested ? &request_ : nullptr; }

  /// Slow side, after requested(): the result to fill in, and the call that hands it over.
  Result& draft() { return results_[current_ ^ 1u]; }
  void made() { __atomic_store_n(&state_, kMade, __ATOMIC_RELEASE); }

  /// As constructed, except the request. Not while either side may run.
  void reset() {
    for (Result& result : results_) result = Result{};
    current_ = 0;
    state_ = kIdle;
  }

 private:
  static constexpr uint32_t kIdle = 0, kRequested = 1, kMade = 2;

  uint32_t state() const { return __atomic_load_n(&state_, __ATOMIC_ACQUIRE); }

  uint32_t state_ = kIdle;
  uint32_t current_ = 0;  // index of result(); changes only while the fast side owns both
  Request request_{};
  Result results_[2] = {};
};

}  // namespace firmtouch::core
