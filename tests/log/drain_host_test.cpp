#include "firmtouch/record/ring.hpp"
#include "harness/test.hpp"
#include "log/drain.hpp"
#include "log/fake_disk.hpp"
#include "log/sample_log.hpp"

// The writer against a clock and a disk that do what a test wants: no thread, no waiting.
namespace firmtouch::log_test {
namespace {

constexpr double kRate_Hz = 10000;

// 128 bytes in the ring and on the disk.
struct Payload {
  uint32_t clock_us;
  uint32_t words[30];
};
using Slot = record::Numbered<Payload>;
static_assert(sizeof(Slot) == 128);

Payload payload_of(uint32_t number) {
  Payload payload{};
  payload.clock_us = number * 100;
  for (uint32_t k = 0; k < 30; ++k) payload.words[k] = number * (k + 1);
  return payload;
}

log::Header slot_header() {
  log::Header made;
  made.fields = {{"number", "1", 1, 0, log::Type::kU32, 1, 0},
                 {"input.clock_us", "s", 1e-6, 0, log::Type::kU32, 1, 0},
                 {"words", "1", 1, 0, log::Type::kU32, 30, 0}};
  made.record_bytes = log::place(made.fields);
  return made;
}

// A servo at 10 kHz, a ring, the drain and the disk, for some time.
template <uint32_t Capacity>
struct Scene {
  using Ring = record::Ring<Payload, Capacity>;
  explicit Scene(log::DrainOptions options = {})
      : ring(std::make_unique<Ring>()),
        records(*ring),
        drain(std::make_unique<log::Drain>(
            records, slot_header(), options,
            [this](uint32_t part, std::string& problem) -> std::unique_ptr<log::Sink> {
              if (disk.now_s >= disk.full_from_s && disk.now_s < disk.full_to_s) {
                problem = "no space left on the fake disk";
                return nullptr;
              }
              return std::make_unique<FakeFile>(disk, part);
            },
            [this](uint32_t part) { removed.push_back(part); })) {
    disk.meanwhile = [this](double now_s) { produce(now_s); };
  }
  void produce(double now_s) {
    while (!is_over && static_cast<double>(made) <= now_s * kRate_Hz) {
      ring->push(payload_of(made));
      ++made;
    }
  }
  bool run(double seconds) {
    while (disk.now_s < seconds)
      if (!drain->step(disk.now_s)) disk.pass(0.005);
    is_over = true;
    return drain->finish();
  }
  // Its files are closed, and can be read.
  FakeDisk& close() {
    drain.reset();
    return disk;
  }

  FakeDisk disk;
  std::unique_ptr<Ring> ring;
  log::RingRecords<Ring> records;
  std::vector<uint32_t> removed;
  uint32_t made = 0;
  bool is_over = false;
  std::unique_ptr<log::Drain> drain;
};

struct Counts {
  uint64_t records = 0, missing = 0, wrong = 0;
  std::vector<log::Gap> gaps;
  bool is_whole = false;
};

Counts count(const Bytes& bytes) {
  log::Reader reader(log::over_memory(bytes), "memory");
  Counts counts;
  log::Block block;
  const auto compare = [&](const Slot& slot) {
    const Payload expected = payload_of(slot.number);
    if (std::memcmp(&expected, &slot.value, sizeof expected) != 0) ++counts.wrong;
  };
  while (read_block<Slot>(reader, block, compare)) {
  }
  counts.records = reader.records();
  counts.missing = reader.missing();
  counts.gaps = reader.gaps();
  counts.is_whole = reader.is_whole();
  return counts;
}

// Runs a scene to its end and reads what it left: all except what the ring dropped, in one gap.
template <uint32_t Capacity>
Counts outcome(std::unique_ptr<Scene<Capacity>> scene, double seconds) {
  CHECK(scene->run(seconds));
  const uint32_t made = scene->made, dropped = scene->ring->dropped();
  CHECK_EQ(scene->ring->consumed() + dropped, made);
  CHECK_EQ(scene->drain->totals().missing, dropped);
  const Counts counts = count(scene->close().files[0]);
  CHECK_EQ(counts.missing, dropped);
  CHECK_EQ(counts.records + dropped, made);
  CHECK_EQ(counts.gaps.size(), dropped > 0 ? 1u : 0u);
  CHECK_EQ(counts.wrong, 0u);
  CHECK(counts.is_whole);
  return counts;
}

TEST(AStallOfFiveSecondsLosesNothingInTheDefaultRing) {
  constexpr uint32_t kDefault = 65536;  // 8 MiB
  log::DrainOptions options;
  options.file_bytes = 16u << 20;  // what ten minutes hold need not lie in memory at once
  auto scene = std::make_unique<Scene<kDefault>>(options);
  scene->disk.stall_from_s = 4;
  scene->disk.stall_s = 5;
  uint64_t records = 0, missing = 0, wrong = 0;
  bool is_whole = true;
  scene->disk.closed = [&](const Bytes& bytes) {
    const Counts counts = count(bytes);
    records += counts.records;
    missing += counts.missing;
    wrong += counts.wrong;
    is_whole &= counts.is_whole;
  };
  CHECK(scene->run(is_long() ? 600 : 15));
  CHECK_EQ(scene->drain->totals().missing, 0u);
  CHECK_GE(scene->drain->totals().max_waiting, 50000u);  // it did stall
  scene->close();
  CHECK_EQ(scene->ring->dropped(), 0u);
  CHECK_EQ(missing, 0u);
  CHECK_EQ(records, scene->made);
  CHECK_GE(scene->made, is_long() ? 6000000u : 150000u);
  CHECK_EQ(wrong, 0u);
  CHECK(is_whole);
}

TEST(ASmallRingLosesExactlyWhatDoesNotFitAndTheLogSaysWhere) {
  constexpr uint32_t kSmall = 4096;
  auto scene = std::make_unique<Scene<kSmall>>();
  scene->disk.stall_from_s = 4;
  scene->disk.stall_s = 5;
  const Counts counts = outcome(std::move(scene), 15);
  // Of the 50,000 records of the stall as many were kept as the ring had slots free.
  CHECK_GE(counts.missing, 50000u - kSmall);
  CHECK_LE(counts.missing, 50000u - kSmall + 1024u);
  CHECK_EQ(counts.gaps[0].count, counts.missing);
  CHECK_EQ(counts.gaps[0].of_blocks, 0u);
  // The first that is there again was made when the stall had ended.
  CHECK_GE(counts.gaps[0].number, 90000u);
  CHECK_LE(counts.gaps[0].number, 91000u);  // it began with the first write behind 4 s
}

TEST(FullDisk_IsTriedAgain_LostRecordsAreCounted) {
  auto scene = std::make_unique<Scene<4096>>();
  scene->disk.full_from_s = 3;
  scene->disk.full_to_s = 6;
  CHECK_GE(outcome(std::move(scene), 10).missing, 20000u);
}

TEST(DiskStaysFull_EveryWholeBlockIsReadable) {
  auto scene = std::make_unique<Scene<4096>>();
  scene->disk.full_from_s = 3;
  CHECK(!scene->run(5));
  CHECK(scene->drain->totals().failures > 0);
  CHECK(scene->drain->totals().problem.find("no space left") != std::string::npos);
  const uint64_t written = scene->drain->totals().records;
  CHECK_GE(written, 29000u);
  const Counts counts = count(scene->close().files[0]);
  CHECK_EQ(counts.records, written);
  CHECK_EQ(counts.missing, 0u);
  CHECK_EQ(counts.wrong, 0u);
  CHECK(!counts.is_whole);
}

TEST(ASlowDiskThatKeepsUpLosesNothing) {
  auto scene = std::make_unique<Scene<4096>>();
  scene->disk.bytes_per_s = 1.5e6;  // 1.28e6 are needed
  CHECK_EQ(outcome(std::move(scene), 5).missing, 0u);
}

TEST(FilesRotateEachWholeAndTheOldestGo) {
  log::DrainOptions options;
  options.file_bytes = 1000000;
  options.keep_files = 3;
  auto scene = std::make_unique<Scene<4096>>(options);
  CHECK(scene->run(5));
  const uint32_t files = scene->drain->totals().files;
  CHECK_GE(files, 6u);
  CHECK_EQ(scene->removed.size(), files - 3);
  CHECK_EQ(scene->drain->totals().missing, 0u);
  uint64_t records = 0;
  for (const auto& file : scene->close().files) {
    const Counts counts = count(file.second);
    records += counts.records;
    CHECK(counts.is_whole);
    CHECK_EQ(counts.missing, 0u);
    CHECK_EQ(counts.wrong, 0u);
  }
  CHECK_EQ(records, scene->made);
}

}  // namespace
}  // namespace firmtouch::log_test
