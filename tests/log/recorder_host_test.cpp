#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <new>
#include <thread>

#include "firmtouch/record/ring.hpp"
#include "harness/test.hpp"
#include "log/edit.hpp"
#include "log/file_sink.hpp"
#include "log/recorder.hpp"
#include "log/sample_log.hpp"

// The recorder on a real disk, with its thread, and with a process that is killed.
namespace firmtouch::log_test {
namespace {

struct Payload {
  uint32_t clock_us;
  float force_N;
  uint32_t faults;
};
Payload payload_of(uint32_t number) {
  const Row row = row_of(number);
  return {row.clock_us, row.force_N, row.faults};
}
using Ring = record::Ring<Payload, 4096>;

uint64_t wrong_rows(const std::string& path, log::Reader& reader) {
  CHECK(!path.empty());
  uint64_t wrong = 0;
  log::Block block;
  while (reader.next(block)) {
    for (uint32_t i = 0; i < block.count; ++i) {
      const Row expected = row_of(log::word(block.record(i), 0));
      if (std::memcmp(&expected, block.record(i), sizeof expected) != 0) ++wrong;
    }
  }
  return wrong;
}

TEST(Recorder_EveryRecord_IsWrittenOrCounted) {
  Folder folder;
  const std::string path = folder.name + "/run.ftl";
  auto ring = std::make_unique<Ring>();
  log::RingRecords<Ring> records(*ring);
  constexpr uint32_t kRecords = 200000;
  log::Recorder recorder(records, header(), {}, path);
  for (uint32_t i = 0; i < kRecords; ++i) {
    ring->push(payload_of(i));
    if (i % 1000 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(recorder.stop());
  log::Reader reader(log::open_file(path), path);
  CHECK_EQ(wrong_rows(path, reader), 0u);
  CHECK(reader.is_whole());
  CHECK_EQ(reader.records() + reader.missing(), kRecords);
  CHECK_EQ(reader.missing(), ring->dropped());
  CHECK_EQ(ring->produced(), kRecords);
}

// A real file whose disk stands still once, as one that spins up or is trimmed does.
class StallingFile : public log::Sink {
 public:
  StallingFile(std::unique_ptr<log::Sink> file, std::atomic<int64_t>& stall_ms)
      : file_(std::move(file)), stall_ms_(stall_ms) {}
  bool write(uint64_t offset, Part first, Part second) override {
    if (const int64_t ms = stall_ms_.exchange(0); ms > 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    return file_->write(offset, first, second);
  }
  void reserve(uint64_t bytes) override { file_->reserve(bytes); }
  bool sync() override { return file_->sync(); }
  bool end_at(uint64_t bytes) override { return file_->end_at(bytes); }
  std::string problem() const override { return file_->problem(); }

 private:
  std::unique_ptr<log::Sink> file_;
  std::atomic<int64_t>& stall_ms_;
};

// A ring of records of 128 B, its recorder's thread and its file.
struct Wide {
  uint32_t clock_us;
  uint32_t words[30];
};
template <uint32_t Capacity>
struct Lane {
  using Ring = record::Ring<Wide, Capacity>;
  static_assert(sizeof(record::Numbered<Wide>) == 128);
  explicit Lane(const std::string& file) : path(file) {
    log::Header head;
    head.fields = {{"number", "1", 1, 0, log::Type::kU32, 1, 0},
                   {"input.clock_us", "s", 1e-6, 0, log::Type::kU32, 1, 0},
                   {"words", "1", 1, 0, log::Type::kU32, 30, 0}};
    recorder = std::make_unique<log::Recorder>(
        records, head, log::DrainOptions{},
        [this](uint32_t, std::string& problem) -> std::unique_ptr<log::Sink> {
          return std::make_unique<StallingFile>(log::make_file(path, problem), stall_ms);
        },
        [](uint32_t) {});
  }
  // Reads the log back: result, how many of its records are not those that were made.
  uint64_t wrong(uint64_t& read, std::vector<log::Gap>& gaps) const {
    log::Reader reader(log::open_file(path), path);
    uint64_t wrong = 0;
    log::Block block;
    while (reader.next(block))
      for (uint32_t i = 0; i < block.count; ++i)
        for (uint32_t k = 0; k < 31; ++k)
          wrong += log::word(block.record(i), 4 + 4 * k) != log::word(block.record(i), 0) * (k + 1);
    read = reader.records();
    gaps = reader.gaps();
    return wrong + (reader.is_whole() ? 0 : 1);
  }

  std::string path;
  std::atomic<int64_t> stall_ms{0};
  std::unique_ptr<Ring> ring = std::make_unique<Ring>();
  log::RingRecords<Ring> records{*ring};
  std::unique_ptr<log::Recorder> recorder;
};

// In real time: ten minutes and a stall of 5 s (FIRMTOUCH_LONG), else a second and half of one. One
// ring of the default size, and one that holds 0.1 s.
TEST(Stall_DefaultRingLosesNothing_At10kHz) {
  const Folder folder;
  Lane<65536> usual(folder.name + "/usual.ftl");
  Lane<1024> small(folder.name + "/small.ftl");
  const double seconds = is_long() ? 600 : 1.2;
  const int64_t stall_ms = is_long() ? 5000 : 500;
  std::vector<log::Gap> lost;  // what the small ring refused, as its producer saw it
  uint32_t made = 0;
  bool has_stalled = false;
  const auto begin = std::chrono::steady_clock::now();
  for (double now_s = 0; now_s < seconds;) {
    for (; made < now_s * 10000; ++made) {
      Wide value;
      value.clock_us = made;
      for (uint32_t k = 0; k < 30; ++k) value.words[k] = made * (k + 2);
      usual.ring->push(value);
      if (small.ring->push(value)) continue;
      if (lost.empty() || lost.back().number != made) lost.push_back({made, 0, 0});
      ++lost.back().count;
      ++lost.back().number;  // of the record behind the gap
    }
    if (!has_stalled && now_s > seconds / 3) {
      usual.stall_ms = small.stall_ms = stall_ms;
      has_stalled = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  CHECK(usual.recorder->stop());
  CHECK(small.recorder->stop());
  test::note("records made", made);
  uint64_t read = 0;
  std::vector<log::Gap> gaps;
  CHECK_EQ(usual.wrong(read, gaps), 0u);
  CHECK_EQ(read, made);
  CHECK_EQ(gaps.size(), 0u);
  CHECK_EQ(usual.ring->dropped(), 0u);
  CHECK_GE(usual.recorder->totals().max_waiting, static_cast<uint32_t>(stall_ms) * 5);

  CHECK_EQ(small.wrong(read, gaps), 0u);
  CHECK_EQ(read + small.ring->dropped(), made);
  CHECK_GE(small.ring->dropped(), static_cast<uint32_t>(stall_ms) * 5);
  CHECK_EQ(gaps.size(), lost.size());
  for (size_t i = 0; i < gaps.size() && i < lost.size(); ++i) {
    CHECK_EQ(gaps[i].number, lost[i].number);
    CHECK_EQ(gaps[i].count, lost[i].count);
  }
}

TEST(FileThatCannotBeMade_IsReportedWithoutHarm) {
  auto ring = std::make_unique<Ring>();
  log::RingRecords<Ring> records(*ring);
  log::Recorder recorder(records, header(), {}, "/nowhere/run.ftl");
  for (uint32_t i = 0; i < 10000; ++i) ring->push(payload_of(i));
  std::string trouble;  // reported while recording continues
  for (int i = 0; i < 1000 && trouble.empty(); ++i, trouble = recorder.trouble())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(trouble.find("/nowhere/run.ftl") != std::string::npos);
  CHECK(!recorder.stop());
  CHECK(recorder.totals().problem.find("/nowhere/run.ftl") != std::string::npos);
  CHECK_EQ(ring->dropped(), 10000u - 4096u);
}

// Writes without end, reporting after each step how many records are on the disk.
[[noreturn]] void write_until_killed(const std::string& path, std::atomic<uint64_t>& reported) {
  auto ring = std::make_unique<Ring>();
  log::RingRecords<Ring> records(*ring);
  log::DrainOptions options;
  options.block_records = 37;
  options.reserve_bytes = 1u << 20;
  log::Drain drain(
      records, header(), options,
      [&](uint32_t, std::string& problem) { return log::make_file(path, problem); },
      [](uint32_t) {});
  double now_s = 0;
  for (uint32_t i = 0;; ++i) {
    ring->push(payload_of(i));
    while (drain.step(now_s += 1e-4)) {
    }
    reported.store(drain.totals().records, std::memory_order_release);
  }
}

TEST(AfterAKillEveryBlockThatWasWrittenIsReadable) {
  Folder folder;
  void* const shared =
      ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  CHECK(shared != MAP_FAILED);
  Random random(3);
  const uint32_t rounds = is_long() ? 200 : 12;
  for (uint32_t round = 0; round < rounds; ++round) {
    test::note("round", round);
    auto* reported = new (shared) std::atomic<uint64_t>(0);
    const std::string path = folder.name + "/killed.ftl";
    const pid_t child = ::fork();
    if (child == 0) write_until_killed(path, *reported);
    while (reported->load(std::memory_order_acquire) == 0) ::usleep(200);
    ::usleep(static_cast<useconds_t>(random.below(20000)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    log::Reader reader(log::open_file(path), path);
    CHECK_EQ(wrong_rows(path, reader), 0u);
    CHECK_GE(reader.records(), reported->load());
    CHECK_EQ(reader.missing(), 0u);
    CHECK(!reader.is_closed());
    // What was cut off can be closed again.
    CHECK_EQ(log::join({path}, folder.name + "/closed.ftl"), reader.records());
    log::Reader closed(log::open_file(folder.name + "/closed.ftl"), "closed");
    log::read_through(closed);
    CHECK(closed.is_whole());
  }
  ::munmap(shared, 4096);
}

}  // namespace
}  // namespace firmtouch::log_test
