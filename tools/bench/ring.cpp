#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "bench/all_benches.hpp"
#include "bench/peer.hpp"
#include "firmtouch/record/ring.hpp"

// Records of 128 B from one thread to another: record::Ring, read in place, against a
// mutex-guarded std::deque of the same capacity, and against an outside program:
//     COMMAND ring RECORD_BYTES TRANSFERS      prints `us_per_query X`, microseconds a transfer:
//     the
//                                              least of 20 runs of so many, capacity 1,024
// Timed from when both threads are there. Whoever finds the ring full, or fewer records than a
// batch in it, yields; one word of every record is looked at. Where other programs want the
// processors too, a long run shows how the system shares them out: so 20 short ones a pass, of
// which the least disturbed and the median are reported.
namespace firmtouch::bench {
namespace {

constexpr uint32_t kTransfers = 50000;  // or four times the capacity, where that is more
constexpr uint32_t kRuns = 20;
constexpr uint32_t kBatch = 128;  // the reader looks again where fewer wait

struct Payload {
  uint32_t words[31];
};
static_assert(sizeof(record::Numbered<Payload>) == 128);

// Runs `fill` on a thread of its own beside `drain`. Result: microseconds from when both are there.
template <class Fill, class Drain>
double together_us(Fill fill, Drain drain) {
  bool is_there = false, is_begun = false;
  std::thread producer([&] {
    __atomic_store_n(&is_there, true, __ATOMIC_RELEASE);
    while (!__atomic_load_n(&is_begun, __ATOMIC_ACQUIRE)) std::this_thread::yield();
    fill();
  });
  while (!__atomic_load_n(&is_there, __ATOMIC_ACQUIRE)) std::this_thread::yield();
  const auto begin = std::chrono::steady_clock::now();
  __atomic_store_n(&is_begun, true, __ATOMIC_RELEASE);
  volatile uint32_t sum = drain();
  (void)sum;
  const std::chrono::duration<double, std::micro> passed = std::chrono::steady_clock::now() - begin;
  producer.join();
  return passed.count();
}

template <uint32_t Capacity>
double through_ring(uint32_t transfers) {
  // Once: a ring is fixed memory. A deque allocates its own on the way.
  static const auto ring = std::make_unique<record::Ring<Payload, Capacity>>();
  const auto fill = [&] {
    Payload payload{};
    for (uint32_t i = 0; i < transfers; ++i) {
      payload.words[30] = i;
      while (!ring->push(payload)) std::this_thread::yield();
    }
  };
  return together_us(fill, [&] {
    uint32_t sum = 0;
    for (uint32_t got = 0; got < transfers;) {
      if (ring->waiting() < kBatch && got + kBatch < transfers) {
        std::this_thread::yield();
        continue;
      }
      const auto ready = ring->ready();
      for (uint32_t i = 0; i < ready.size(); ++i) sum += ready[i].value.words[30] & 1u;
      ring->release(ready.size());
      got += ready.size();
    }
    return sum;
  });
}

// Of both readers of a deque: into it, one lock a record.
void fill(std::mutex& mutex, std::deque<Payload>& deque, uint32_t capacity, uint32_t transfers) {
  Payload payload{};
  for (uint32_t i = 0; i < transfers; ++i) {
    payload.words[30] = i;
    for (;;) {
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (deque.size() < capacity) {
          deque.push_back(payload);
          break;
        }
      }
      std::this_thread::yield();
    }
  }
}

template <uint32_t Capacity>
double through_deque(uint32_t transfers) {
  std::mutex mutex;
  std::deque<Payload> deque;
  return together_us([&] { fill(mutex, deque, Capacity, transfers); },
                     [&] {
                       uint32_t sum = 0;
                       for (uint32_t got = 0; got < transfers;) {
                         Payload payload;
                         bool any = false;
                         {
                           const std::lock_guard<std::mutex> lock(mutex);
                           any = !deque.empty();
                           if (any) {
                             payload = deque.front();
                             deque.pop_front();
                           }
                         }
                         if (any)
                           sum += payload.words[30] & 1u, ++got;
                         else
                           std::this_thread::yield();
                       }
                       return sum;
                     });
}

// The best that a lock can do for its reader: it waits for a batch as the ring's does, and takes
// all that waits under one lock, without a copy.
template <uint32_t Capacity>
double through_swapped_deque(uint32_t transfers) {
  std::mutex mutex;
  std::deque<Payload> deque, taken;
  return together_us([&] { fill(mutex, deque, Capacity, transfers); },
                     [&] {
                       uint32_t sum = 0;
                       for (uint32_t got = 0; got < transfers;) {
                         {
                           const std::lock_guard<std::mutex> lock(mutex);
                           if (deque.size() >= kBatch || got + kBatch >= transfers)
                             deque.swap(taken);
                         }
                         for (const Payload& payload : taken) sum += payload.words[30] & 1u;
                         got += static_cast<uint32_t>(taken.size());
                         if (taken.empty()) std::this_thread::yield();
                         taken.clear();
                       }
                       return sum;
                     });
}

double middle(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  return list[list.size() / 2];
}

// A contender that reports its least disturbed run, and keeps the median one of each pass beside
// it.
struct Entry {
  const char* name;
  double (*run)(uint32_t transfers);  // microseconds of all
  std::vector<double> medians_us = {};
};

Contender contender(Entry& entry, uint32_t transfers) {
  return [&entry, transfers] {
    std::vector<double> us;
    for (uint32_t i = 0; i < kRuns; ++i) us.push_back(entry.run(transfers) / transfers);
    entry.medians_us.push_back(middle(us));
    return *std::min_element(us.begin(), us.end());
  };
}

template <uint32_t Capacity>
void race(const Peer* peer, uint32_t min_transfers, bool is_bar, Report& report) {
  const uint32_t transfers = std::max(min_transfers, 4 * Capacity);
  report.heading("Records of 128 B, thread to thread, " + std::to_string(transfers) +
                 " transfers, capacity " + std::to_string(Capacity));
  report.stage("transfers, capacity " + std::to_string(Capacity));
  Entry entries[] = {
      {"record::Ring, read in place", through_ring<Capacity>},
      {"mutex-guarded std::deque", through_deque<Capacity>},
      {"the deque, all that waits taken under one lock", through_swapped_deque<Capacity>}};
  std::vector<Contender> contenders;
  for (Entry& entry : entries) contenders.push_back(contender(entry, transfers));
  if (peer != nullptr)
    contenders.push_back(peer->contender("ring", "128", std::to_string(transfers)));
  const std::vector<double> min_us = medians_us(contenders);
  for (size_t i = 0; i < 3; ++i) {
    report.figure(entries[i].name, "", min_us[i] * 1e3, "ns a record", "least of 20 runs");
    report.figure("the same", "", middle(entries[i].medians_us) * 1e3, "ns a record",
                  "median of 20 runs");
  }
  const double median_us = middle(entries[0].medians_us);
  const auto against = [&](const std::string& what, double times) {
    if (is_bar)
      report.bar_at_least(what, "", times, "x", 10);
    else
      report.figure(what, "", times, "x", "");
  };
  against("throughput against the deque, least runs", min_us[1] / min_us[0]);
  report.figure("the same, median runs", "", middle(entries[1].medians_us) / median_us, "x", "");
  report.figure("throughput against the deque taken under one lock, least runs", "",
                min_us[2] / min_us[0], "x", "");
  report.figure("the same, median runs", "", middle(entries[2].medians_us) / median_us, "x", "");
  if (peer != nullptr) {
    report.figure("peer", "", min_us[3] * 1e3, "ns a record", "least of 20 runs");
    report.bar_at_least("throughput against the peer, least runs", "", min_us[3] / min_us[0], "x",
                        1);
  }
}

}  // namespace

void run_ring(const Options& options, Report& report) {
  const uint32_t transfers = options.is_long ? 4 * kTransfers : kTransfers;
  const Peer peer(options.peer);
  race<1024>(peer.is_present() ? &peer : nullptr, transfers, false, report);
  race<65536>(nullptr, transfers, true, report);  // as the recorder's
  if (!peer.is_present()) report.absent("throughput against the peer", "", kPeerAbsent);
}

}  // namespace firmtouch::bench
