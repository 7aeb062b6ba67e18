#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>

#include "harness/test.hpp"
#include "log/sample_log.hpp"

// Each rule by which a log or one of its blocks is refused, broken alone: all CRCs are right again.
namespace firmtouch::log_test {
namespace {

using log::BlockHead;
using log::FileHead;

Bytes sample() { return log_of({{0, 1, 2}, {3, 4}, {7, 8}}); }

// Block `i` of sample() lies here.
uint64_t block_at(const Bytes& bytes, uint32_t i) {
  uint64_t at = first_block(bytes);
  for (; i > 0; --i) at += sizeof(BlockHead) + get<BlockHead>(bytes, at).payload_bytes;
  return at;
}

template <class T>
uint32_t rule_when(uint64_t at, const std::function<void(T&)>& change, bool is_repaired = true) {
  Bytes bytes = sample();
  T value = get<T>(bytes, at);
  change(value);
  put(bytes, at, value);
  if (is_repaired) repair(bytes);
  return rule_of(bytes);
}

uint32_t rule_of_block(uint32_t i, const std::function<void(BlockHead&)>& change) {
  return rule_when<BlockHead>(block_at(sample(), i), change);
}

// The sample with another text in its head.
uint32_t rule_of_text(const std::function<std::string(std::string)>& change) {
  const Bytes whole = sample();
  FileHead head = get<FileHead>(whole, 0);
  const char* begin = reinterpret_cast<const char*>(whole.data()) + sizeof head;
  const std::string text = change(std::string(begin, head.text_bytes));
  head.text_bytes = static_cast<uint32_t>(text.size());
  Bytes bytes(sizeof head + text.size() + whole.size() - first_block(whole));
  put(bytes, 0, head);
  for (size_t i = 0; i < text.size(); ++i) bytes[sizeof head + i] = static_cast<uint8_t>(text[i]);
  for (uint64_t i = first_block(whole); i < whole.size(); ++i)
    bytes[sizeof head + text.size() + i - first_block(whole)] = whole[i];
  repair(bytes);
  return rule_of(bytes);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const size_t at = text.find(what);
  CHECK(at != std::string::npos);
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

TEST(TheSampleIsRefusedByNoRule) { CHECK_EQ(rule_of(sample()), 0u); }

TEST(RulesOfTheHead) {
  CHECK_EQ(rule_when<uint8_t>(0, [](uint8_t& c) { c = 'f'; }), 1u);
  CHECK_EQ(rule_of({'F', 'T', 'L'}), 1u);
  CHECK_EQ(rule_when<FileHead>(0, [](FileHead& h) { h.major = 3; }), 2u);
  CHECK_EQ(rule_when<FileHead>(0, [](FileHead& h) { h.minor = 9; }), 0u);  // any minor is read
  CHECK_EQ(rule_when<FileHead>(
               0, [](FileHead& h) { h.minor = 9; }, false),
           3u);
  CHECK_EQ(rule_when<FileHead>(0, [](FileHead& h) { h.reserved = 1; }), 6u);
  for (const uint32_t bytes : {0u, 18u, log::kMaxRecordBytes + 4})
    CHECK_EQ(rule_when<FileHead>(0, [&](FileHead& h) { h.record_bytes = bytes; }), 7u);
}

TEST(RulesOfTheText) {
  Bytes bytes = sample();
  bytes.resize(first_block(bytes) - 1);
  CHECK_EQ(rule_of(bytes), 4u);
  CHECK_EQ(rule_when<uint8_t>(
               sizeof(FileHead) + 3, [](uint8_t& c) { c ^= 1; }, false),
           5u);
  for (const char* line : {"field u64 1 a m 1 0", "field u32 0 a m 1 0", "field u32 1 a m x 0",
                           "field u32 1 number 1 1 0", "field u32 1 a", "bit output.faults 32 a",
                           "bit output.faults 1", "decimation 0", "word", "asset twice"})
    CHECK_EQ(rule_of_text([&](std::string text) { return text + line + "\n"; }), 8u);
  CHECK_EQ(rule_of_text([](std::string text) { return text + "field u32 1 more m 1 0\n"; }), 9u);
  CHECK_EQ(rule_of_text([](const std::string&) { return std::string(); }), 9u);
  CHECK_EQ(rule_of_text([](std::string text) {
             return replaced(text, "field u32 1 number", "field u32 1 nomber");
           }),
           10u);
  CHECK_EQ(rule_of_text([](std::string text) {
             return replaced(text, "field u32 1 number", "field i32 1 number");
           }),
           10u);
  // Words of another version are kept for whoever knows them.
  CHECK_EQ(rule_of_text([](std::string text) { return replaced(text, "asset two", "novel two"); }),
           0u);
}

TEST(RulesOfABlocksHead) {
  const auto unrepaired = [](uint32_t i, const std::function<void(BlockHead&)>& change) {
    return rule_when<BlockHead>(block_at(sample(), i), change, false);
  };
  CHECK_EQ(unrepaired(1, [](BlockHead& h) { h.magic ^= 1; }), 20u);
  CHECK_EQ(unrepaired(1, [](BlockHead& h) { h.head_crc ^= 1; }), 20u);
  // Of another log, whole in itself.
  const auto foreign = [](BlockHead& h) {
    h.log ^= 1;
    h.head_crc = crc_of(reinterpret_cast<const uint8_t*>(&h), offsetof(BlockHead, head_crc));
  };
  CHECK_EQ(unrepaired(1, foreign), 21u);
  CHECK_EQ(rule_of_block(1, [](BlockHead& h) { h.sequence = 0; }), 22u);
  CHECK_EQ(rule_of_block(1, [](BlockHead& h) { h.kind = 3; }), 23u);
  CHECK_EQ(rule_of_block(1, [](BlockHead& h) { h.count += 1; }), 24u);
  CHECK_EQ(rule_of_block(1, [](BlockHead& h) { h.reserved[2] = 1; }), 28u);
  const auto unchained = [](BlockHead& h) {
    h.previous_crc ^= 1;
    h.head_crc = crc_of(reinterpret_cast<const uint8_t*>(&h), offsetof(BlockHead, head_crc));
  };
  CHECK_EQ(unrepaired(1, unchained), 27u);
  Bytes cut = log_of({{0, 1, 2}, {3, 4}}, 1, false);
  cut.pop_back();
  CHECK_EQ(rule_of(cut), 25u);
  cut.resize(block_at(cut, 1) + 10);
  CHECK_EQ(rule_of(cut), 25u);
}

TEST(RulesOfABlocksRecords) {
  const uint64_t payload = block_at(sample(), 1) + sizeof(BlockHead);
  CHECK_EQ(rule_when<uint8_t>(
               payload + 5, [](uint8_t& c) { c ^= 0x40; }, false),
           26u);
  CHECK_EQ(rule_when<uint32_t>(payload, [](uint32_t& n) { n = 2; }), 29u);
  CHECK_EQ(rule_when<uint32_t>(payload + sizeof(Row), [](uint32_t& n) { n = 3; }), 29u);
  CHECK_EQ(rule_when<uint32_t>(payload + sizeof(Row), [](uint32_t& n) { n = 1; }), 29u);
  CHECK_EQ(rule_of_block(1, [](BlockHead& h) { h.first_number = 4; }), 29u);
  CHECK_EQ(rule_of_block(2, [](BlockHead& h) { h.missing += 1; }), 30u);
  CHECK_EQ(rule_of_block(2, [](BlockHead& h) { h.missing -= 1; }), 30u);
}

TEST(RulesOfTheEnd) {
  const uint64_t end = block_at(sample(), 3), index = end + sizeof(BlockHead);
  CHECK_EQ(rule_of_block(3, [](BlockHead& h) { h.first_number = 8; }), 30u);
  CHECK_EQ(rule_when<log::IndexEntry>(index + 24, [](log::IndexEntry& e) { e.count = 1; }), 31u);
  CHECK_EQ(rule_when<log::IndexEntry>(index + 24, [](log::IndexEntry& e) { e.sequence = 7; }), 31u);
  const uint64_t tail = sample().size() - sizeof(log::Tail);
  CHECK_EQ(rule_when<log::Tail>(tail, [](log::Tail& t) { t.end_offset += 1; }), 32u);
  Bytes longer = sample();
  longer.push_back(0);
  CHECK_EQ(rule_of(longer), 32u);
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::map<int, int> counted(const std::string& text, const char* pattern) {
  std::map<int, int> counts;
  const std::regex rule(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), rule), end; at != end; ++at)
    ++counts[std::stoi((*at)[1])];
  return counts;
}

TEST(EveryRuleOfTheReaderStandsInTheFormatPageOnce) {
  const std::filesystem::path root = FIRMTOUCH_ROOT;
  const std::map<int, int> used =
      counted(text_of(root / "tools/log/reader.cpp"), R"(\bkRule\w+\s*=\s*(\d+))");
  const std::map<int, int> reported = counted(text_of(root / "tools/FORMAT.md"), R"(\| L(\d+) \|)");
  CHECK_EQ(used.size(), 23u);
  CHECK(used == reported);
}

}  // namespace
}  // namespace firmtouch::log_test
