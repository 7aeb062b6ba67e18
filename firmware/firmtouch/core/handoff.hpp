#pragma once
#include <stdint.h>

namespace firmtouch::core {

/// A question from a fast context to a slow one, and its answer back through a double buffer: the
/// servo interrupt goes on with the last answer while the next one is made below it. Wait-free on
/// both sides, between an interrupt and what it interrupts as well as between two threads.
///
/// One word says whose the question and the spare answer are:
///   kIdle   the fast side's; it may ask.
///   kAsked  the slow side's, until made(). The fast side reads its own answer, the other of the two.
///   kMade   the fast side's again, which takes it when it likes: the two answers change places.
/// Each change is made by the side that owns, so that a load and a store are enough. Both stores
/// release and both loads acquire: what was written before the word changed is seen behind it.
/// tests/core/handoff.pml is a model of these steps with store buffers and early loads: all four are
/// shown to be needed there, and the relaxed store of take() to be enough.
/// (tests/core/handoff_interrupt_host_test.cpp, tests/core/handoff_threads_host_test.cpp.)
template <class Question, class Answer>
class Handoff {
  static_assert(__is_trivially_copyable(Question) && __is_trivially_copyable(Answer),
                "plain values: they are copied and reset as such");
  static_assert(__atomic_always_lock_free(sizeof(uint32_t), nullptr), "one bus access");

 public:
  /// Fast side. Whether it may ask; whether an answer waits to be taken.
  bool is_idle() const { return state() == kIdle; }
  bool is_made() const { return state() == kMade; }

  /// Fast side.
  /// Result: false, nothing asked, where the slow side is at work or its answer was not taken.
  bool ask(const Question& question) {
    if (state() != kIdle) return false;
    question_ = question;
    __atomic_store_n(&state_, kAsked, __ATOMIC_RELEASE);
    return true;
  }

  /// Fast side: the answer that was made becomes answer().
  /// Result: false, and answer() as it was, where none was made.
  bool take() {
    if (state() != kMade) return false;
    front_ ^= 1u;
    __atomic_store_n(&state_, kIdle, __ATOMIC_RELAXED);  // of its own: nobody else writes now
    return true;
  }

  /// Fast side: its own answer; whatever the slow side does, it does not change.
  const Answer& answer() const { return answers_[front_]; }
  Answer& answer() { return answers_[front_]; }

  /// Slow side.
  /// Result: what was asked; null where nothing is.
  const Question* asked() const { return state() == kAsked ? &question_ : nullptr; }

  /// Slow side, while asked(): where the answer is made. Then made().
  Answer& draft() { return answers_[front_ ^ 1u]; }
  void made() { __atomic_store_n(&state_, kMade, __ATOMIC_RELEASE); }

 private:
  static constexpr uint32_t kIdle = 0, kAsked = 1, kMade = 2;

  uint32_t state() const { return __atomic_load_n(&state_, __ATOMIC_ACQUIRE); }

  uint32_t state_ = kIdle;
  uint32_t front_ = 0;  // changes only while the fast side owns both
  Question question_{};
  Answer answers_[2] = {};
};

}  // namespace firmtouch::core
