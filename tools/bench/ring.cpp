#include <algorithm>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "bench/all_benches.hpp"
#include "bench/peer.hpp"
#include "firmtouch/record/ring.hpp"

// Records of 128 B from one thread to another: record::Ring, read in place, against a
// mutex-guarded std::deque of the same capacity, and against an outside program:
//     COMMAND ring RECORD_BYTES TRANSFERS      prints `us_per_query X`, microseconds a transfer: the
//                                              least of 20 runs of so many
// Whoever finds the ring full, or fewer records than a batch in it, yields; one word of every record
// is looked at. Where other programs want the processors too, a long run tells how the system shares
// them out: so 20 short ones a pass, of which the least disturbed and the median are told.
namespace firmtouch::bench {
namespace {

constexpr uint32_t kCapacity = 1024;
constexpr uint32_t kTransfers = 50000;
constexpr uint32_t kRuns = 20;
constexpr uint32_t kBatch = 128;  // the reader looks again where fewer wait

struct Payload {
  uint32_t words[31];
};
using Ring = record::Ring<Payload, kCapacity>;
static_assert(sizeof(record::Numbered<Payload>) == 128);

double through_ring(uint32_t transfers) {
  const auto ring = std::make_unique<Ring>();
  std::thread producer([&] {
    Payload payload{};
    for (uint32_t i = 0; i < transfers; ++i) {
      payload.words[30] = i;
      while (!ring->push(payload)) std::this_thread::yield();
    }
  });
  double sum = 0;
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
  producer.join();
  return sum;
}

// Of both readers of a deque: into it, one lock a record.
void fill(std::mutex& mutex, std::deque<Payload>& deque, uint32_t transfers) {
  Payload payload{};
  for (uint32_t i = 0; i < transfers; ++i) {
    payload.words[30] = i;
    for (;;) {
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (deque.size() < kCapacity) {
          deque.push_back(payload);
          break;
        }
      }
      std::this_thread::yield();
    }
  }
}

double through_deque(uint32_t transfers) {
  std::mutex mutex;
  std::deque<Payload> deque;
  std::thread producer([&] { fill(mutex, deque, transfers); });
  double sum = 0;
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
  producer.join();
  return sum;
}

// The best that a lock can do for its reader: it waits for a batch as the ring's does, and takes all
// that waits under one lock, without a copy.
double through_swapped_deque(uint32_t transfers) {
  std::mutex mutex;
  std::deque<Payload> deque, taken;
  std::thread producer([&] { fill(mutex, deque, transfers); });
  double sum = 0;
  for (uint32_t got = 0; got < transfers;) {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (deque.size() >= kBatch || got + kBatch >= transfers) deque.swap(taken);
    }
    for (const Payload& payload : taken) sum += payload.words[30] & 1u;
    got += static_cast<uint32_t>(taken.size());
    if (taken.empty()) std::this_thread::yield();
    taken.clear();
  }
  producer.join();
  return sum;
}

// Microseconds a transfer: the least disturbed run, and the median one.
struct Runs {
  double least_us = 0, median_us = 0;
};

Runs runs_of(uint32_t transfers, double (*run)(uint32_t)) {
  std::vector<double> us;
  for (uint32_t i = 0; i < kRuns; ++i)
    us.push_back(timed(transfers, [=] { return run(transfers); })());
  std::sort(us.begin(), us.end());
  return {us.front(), us[us.size() / 2]};
}

}  // namespace

void run_ring(const Options& options, Report& report) {
  const uint32_t transfers = options.is_long ? 4 * kTransfers : kTransfers;
  const Peer peer(options.peer);
  Runs ring, deque, swapped;
  std::vector<double> deque_medians, ring_medians, swapped_medians;
  const auto take = [&](Runs& to, std::vector<double>& medians, double (*run)(uint32_t)) {
    return [&, run] {
      to = runs_of(transfers, run);
      medians.push_back(to.median_us);
      return to.least_us;
    };
  };
  std::vector<Contender> contenders = {take(ring, ring_medians, through_ring),
                                       take(deque, deque_medians, through_deque),
                                       take(swapped, swapped_medians, through_swapped_deque)};
  if (peer.is_present())
    contenders.push_back(peer.contender("ring", "128", std::to_string(transfers)));
  report.heading("Records of 128 B, thread to thread, " + std::to_string(transfers) +
                 " transfers, capacity " + std::to_string(kCapacity));
  report.stage("transfers");
  const std::vector<double> us = medians_us(contenders);
  const auto middle = [](std::vector<double>& list) {
    std::sort(list.begin(), list.end());
    return list[list.size() / 2];
  };
  const double ring_us = middle(ring_medians), deque_us = middle(deque_medians);
  const double swapped_us = middle(swapped_medians);
  report.figure("record::Ring, read in place", "", us[0] * 1e3, "ns a record", "least of 20 runs");
  report.figure("the same", "", ring_us * 1e3, "ns a record", "median of 20 runs");
  report.figure("mutex-guarded std::deque", "", us[1] * 1e3, "ns a record", "least of 20 runs");
  report.figure("the same", "", deque_us * 1e3, "ns a record", "median of 20 runs");
  report.figure("the deque, all that waits taken under one lock", "", us[2] * 1e3, "ns a record",
                "least of 20 runs");
  report.figure("the same", "", swapped_us * 1e3, "ns a record", "median of 20 runs");
  report.figure("throughput against the deque, least runs", "", us[1] / us[0], "x",
                "its threads alternate then, undisturbed");
  report.bar_at_least("throughput against the deque, median runs", "", deque_us / ring_us, "x", 10);
  report.figure("throughput against the deque taken under one lock, least runs", "", us[2] / us[0],
                "x", "");
  report.figure("the same, median runs", "", swapped_us / ring_us, "x", "");
  if (peer.is_present()) {
    report.figure("peer", "", us[3] * 1e3, "ns a record", options.peer);
    report.bar_at_least("throughput against the peer, least runs", "", us[3] / us[0], "x", 1);
  } else {
    report.absent("throughput against the peer", "", kPeerAbsent);
  }
}

}  // namespace firmtouch::bench
