#include "harness/test.hpp"
#include "log/sample_log.hpp"

namespace firmtouch::log_test {
namespace {

bool same(const Row& a, const Row& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(WhatIsWrittenIsReadBack) {
  const Bytes bytes = log_of({{0, 1, 2}, {3}, {4, 5, 6, 7}});
  const Found found = read(bytes);
  CHECK(found.is_closed && found.damage.empty() && found.gaps.empty());
  CHECK_EQ(found.rows.size(), 8u);
  for (uint32_t i = 0; i < found.rows.size(); ++i) CHECK(same(found.rows[i], row_of(i)));
  CHECK(found.troubles.empty());
}

TEST(TheHeadSaysWhatTheRecordsAre) {
  const Bytes bytes = log_of({{0}}, 5);
  const log::Reader reader(log::over_memory(bytes), "memory");
  const log::Header& head = reader.header();
  CHECK_EQ(head.decimation, 5u);
  CHECK(head.text.at("asset") == "two\nlines \\ and a backslash");
  CHECK(head.what("output.faults", 3) == "deadline");
  CHECK(head.what("output.faults", 4) == "bit 4");
  const log::Field* clock = head.find("input.clock_us");
  CHECK(clock != nullptr && clock->unit == "s" && clock->offset == 4);
  const Row row = row_of(123);
  const double seconds = log::value(*clock, 0, reinterpret_cast<const uint8_t*>(&row));
  CHECK(seconds > 0.1229999 && seconds < 0.1230001);
  CHECK(log::text_of(head) == log::text_of([&] {
          log::Header again;
          CHECK(log::parse(log::text_of(head), 16, again).empty());
          return again;
        }()));
}

TEST(MissingRecords_AreReportedWhereTheyAreMissing) {
  // 2 lost inside a block, 3 between blocks, 4 at the very end.
  log::MemorySink sink;
  log::Writer writer(sink, header());
  CHECK(writer.begin());
  for (const std::vector<uint32_t>& numbers :
       std::vector<std::vector<uint32_t>>{{0, 1, 4}, {8, 9}}) {
    std::vector<Row> rows;
    for (const uint32_t number : numbers) rows.push_back(row_of(number));
    CHECK(writer.append(bytes_of(rows), static_cast<uint32_t>(rows.size())));
  }
  CHECK(writer.finish(14));
  CHECK_EQ(writer.missing(), 9u);
  const Found found = read(sink.bytes());
  CHECK_EQ(found.missing, 9u);
  CHECK_EQ(found.gaps.size(), 3u);
  const uint64_t numbers[] = {4, 8, 14}, counts[] = {2, 3, 4};
  for (size_t i = 0; i < 3 && i < found.gaps.size(); ++i) {
    CHECK_EQ(found.gaps[i].number, numbers[i]);
    CHECK_EQ(found.gaps[i].count, counts[i]);
    CHECK_EQ(found.gaps[i].of_blocks, 0u);
  }
  CHECK(found.troubles.empty());  // dropped and counted is not damaged
}

TEST(DecimatedLog_SkippedTicks_AreNotMissing) {
  const Found found = read(log_of({{0, 10, 20}, {50, 60}}, 10));
  CHECK_EQ(found.missing, 2u);
  CHECK_EQ(found.gaps.size(), 1u);
  CHECK_EQ(found.gaps[0].number, 50u);
  CHECK(found.damage.empty());
}

TEST(NumbersGoOnBeyondThirtyTwoBits) {
  const Found found = read(log_of({{0xFFFFFFFEu, 0xFFFFFFFFu, 0}, {1, 3}}));
  CHECK_EQ(found.rows.size(), 5u);
  CHECK_EQ(found.missing, 1u);
  CHECK_EQ(found.blocks[1].first_number, uint64_t{1} << 32 | 1u);
  CHECK_EQ(found.gaps[0].number, uint64_t{1} << 32 | 3u);
  CHECK(found.damage.empty());
}

TEST(AnEmptyLogIsALog) {
  const Found found = read(log_of({}));
  CHECK(found.is_closed && found.rows.empty() && found.damage.empty());
}

// Every place where the power may go, byte by byte.
TEST(TruncatedLog_EveryWholeBlockIsReadable) {
  const Bytes whole = log_of({{0, 1}, {2, 3, 4}, {5}, {6, 7, 8, 9}});
  const std::vector<log::Block> blocks = read(whole).blocks;
  for (uint64_t length = first_block(whole); length < whole.size(); ++length) {
    test::note("length", static_cast<int64_t>(length));
    const Found found = read(Bytes(whole.begin(), whole.begin() + static_cast<long>(length)));
    size_t expected = 0;
    while (expected < blocks.size() &&
           blocks[expected].offset + sizeof(log::BlockHead) + blocks[expected].payload.size() <=
               length)
      ++expected;
    CHECK_EQ(found.blocks.size(), expected);
    for (size_t i = 0; i < found.blocks.size(); ++i)
      CHECK(found.blocks[i].payload == blocks[i].payload);
    // With the module that the recorder had put aside behind it.
    Bytes padded(whole.begin(), whole.begin() + static_cast<long>(length));
    padded.resize(padded.size() + 5000);
    CHECK_EQ(read(padded).blocks.size(), expected);
  }
}

// A power cut may leave any of the pages that were not synced yet unwritten.
TEST(UnwrittenPages_LoseOnlyTheirBlocks) {
  std::vector<std::vector<uint32_t>> numbers;
  for (uint32_t i = 0; i < 60; ++i) {
    numbers.emplace_back();
    for (uint32_t k = 0; k < 1 + i % 7; ++k)
      numbers.back().push_back(numbers.size() == 1 && k == 0 ? 0
                               : k > 0                       ? numbers.back()[k - 1] + 1
                                                             : numbers[i - 1].back() + 1);
  }
  const Bytes whole = log_of(numbers);
  const std::vector<log::Block> blocks = read(whole).blocks;
  CHECK_EQ(blocks.size(), 60u);
  constexpr uint64_t kPage = 128;
  Random random(7);
  for (uint32_t round = 0; round < 300; ++round) {
    test::note("round", round);
    Bytes spoilt = whole;
    std::vector<bool> is_lost(spoilt.size(), false);
    for (uint64_t page = first_block(whole) / kPage + 1; page * kPage < spoilt.size(); ++page) {
      if (random.below(12) != 0) continue;
      for (uint64_t i = page * kPage; i < std::min((page + 1) * kPage, spoilt.size()); ++i) {
        is_lost[i] = spoilt[i] != 0;
        spoilt[i] = 0;
      }
    }
    std::vector<uint32_t> expected;
    uint64_t lost = 0;
    for (const log::Block& block : blocks) {
      const uint64_t end = block.offset + sizeof(log::BlockHead) + block.payload.size();
      bool is_whole = true;
      for (uint64_t i = block.offset; i < end; ++i) is_whole &= !is_lost[i];
      if (is_whole) expected.push_back(block.sequence);
      if (!is_whole) lost += block.count;
    }
    const Found found = read(spoilt);
    CHECK_EQ(found.blocks.size(), expected.size());
    for (size_t i = 0; i < found.blocks.size() && i < expected.size(); ++i)
      CHECK_EQ(found.blocks[i].sequence, expected[i]);
    CHECK_LE(found.missing, lost);  // those before the first whole block and behind the last one
    for (const log::Gap& gap : found.gaps) CHECK_EQ(gap.count, gap.of_blocks);
  }
}

}  // namespace
}  // namespace firmtouch::log_test
