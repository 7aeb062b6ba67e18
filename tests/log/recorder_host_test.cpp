#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
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

TEST(AThreadTakesEveryRecordToTheDiskOrCountsIt) {
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

TEST(AFileThatCannotBeMadeIsToldAndHurtsNobody) {
  auto ring = std::make_unique<Ring>();
  log::RingRecords<Ring> records(*ring);
  log::Recorder recorder(records, header(), {}, "/nowhere/run.ftl");
  for (uint32_t i = 0; i < 10000; ++i) ring->push(payload_of(i));
  CHECK(!recorder.stop());
  CHECK(recorder.totals().problem.find("/nowhere/run.ftl") != std::string::npos);
  CHECK_EQ(ring->dropped(), 10000u - 4096u);
}

// Writes without end, telling after each step how many records are on the disk.
[[noreturn]] void write_until_killed(const std::string& path, std::atomic<uint64_t>& told) {
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
    told.store(drain.totals().records, std::memory_order_release);
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
    auto* told = new (shared) std::atomic<uint64_t>(0);
    const std::string path = folder.name + "/killed.ftl";
    const pid_t child = ::fork();
    if (child == 0) write_until_killed(path, *told);
    while (told->load(std::memory_order_acquire) == 0) ::usleep(200);
    ::usleep(static_cast<useconds_t>(random.below(20000)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    log::Reader reader(log::open_file(path), path);
    CHECK_EQ(wrong_rows(path, reader), 0u);
    CHECK_GE(reader.records(), told->load());
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
