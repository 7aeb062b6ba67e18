#include <fstream>

#include "harness/test.hpp"
#include "log/edit.hpp"
#include "log/plot.hpp"
#include "log/sample_log.hpp"
#include "log/statistics.hpp"

// Logs that are whole, and say what no controller ever would: a CRC is no proof of sense.
namespace firmtouch::log_test {
namespace {

constexpr const char* kNames[] = {"input.clock_us",
                                  "output.force_N",
                                  "output.position_m",
                                  "output.velocity_mps",
                                  "output.distance_m",
                                  "output.distance_lower_m",
                                  "output.faults",
                                  "output.state",
                                  "output.steps",
                                  "output.guide_deviation_m",
                                  "<b>&\"",
                                  "\x1b[2J\x07"};

double wild_number(Random& random) {
  constexpr double kWild[] = {0, 1, -1, 1e-6, 1e308, -1e308, 1e-308, 4e9, 1e-300};
  return kWild[random.below(9)];
}

uint32_t wild_word(Random& random) {
  constexpr uint32_t kWild[] = {0,           1,           0x7F800000u, 0xFF800000u, 0x7FC00000u,
                                0x7F7FFFFFu, 0x80000000u, 0xFFFFFFFFu, 0x3F800000u, 1u};
  return random.below(4) == 0 ? static_cast<uint32_t>(random.next()) : kWild[random.below(10)];
}

log::Header wild_header(Random& random) {
  log::Header made;
  made.fields = {{"number", "1", 1, 0, log::Type::kU32, 1, 0}};
  for (const char* name : kNames) {
    if (random.below(3) == 0) continue;
    const auto type = static_cast<log::Type>(random.below(3));
    const uint32_t count = random.below(8) == 0 ? 40 : static_cast<uint32_t>(1 + random.below(4));
    const bool is_tame = random.below(2) == 0;
    made.fields.push_back({name, random.below(4) == 0 ? "bits" : "<N>",
                           is_tame ? 1 : wild_number(random), is_tame ? 0 : wild_number(random),
                           type, count, 0});
  }
  made.record_bytes = log::place(made.fields);
  for (uint32_t bit = 0; bit < 32; bit += 1 + static_cast<uint32_t>(random.below(9)))
    made.bits.push_back({kNames[random.below(12)], bit, "</svg>\x1b[31m"});
  made.decimation = random.below(3) == 0 ? 0xFFFFFFFFu : 1 + static_cast<uint32_t>(random.below(9));
  made.text["controller"] = "<script>alert(1)\n\x1b]0;x\x07";
  return made;
}

// Blocks of records whose numbers rise, slowly or by leaps, up to the last that 64 bits hold.
Bytes wild_log(Random& random) {
  const log::Header header = wild_header(random);
  log::MemorySink sink;
  log::Writer writer(sink, header);
  writer.begin();
  uint32_t number = static_cast<uint32_t>(random.next());
  for (uint64_t blocks = random.below(5); blocks > 0; --blocks) {
    std::vector<uint32_t> words;
    const uint32_t count = 1 + static_cast<uint32_t>(random.below(5));
    for (uint32_t i = 0; i < count; ++i) {
      number += random.below(3) == 0 ? static_cast<uint32_t>(random.below(0x7FFFFFFF)) : 1;
      words.push_back(number);
      for (uint32_t k = 4; k < header.record_bytes; k += 4) words.push_back(wild_word(random));
    }
    writer.append(reinterpret_cast<const uint8_t*>(words.data()), count);
  }
  if (random.below(4) != 0) writer.finish();
  Bytes bytes = sink.bytes();
  if (random.below(2) == 0) return bytes;
  // The upper half of a block's number, which no record holds.
  for (uint64_t at = first_block(bytes); at + sizeof(log::BlockHead) <= bytes.size();) {
    log::BlockHead head = get<log::BlockHead>(bytes, at);
    head.first_number |= random.below(2) == 0 ? 0xFFFFFFFF00000000u : random.next() << 32;
    if (random.below(3) == 0) head.missing = random.next();
    put(bytes, at, head);
    at += sizeof head + head.payload_bytes;
    if (head.kind == log::kEndBlock) break;
  }
  repair(bytes);
  return bytes;
}

template <class Work>
bool is_done(Work work) {
  try {
    work();
    return true;
  } catch (const std::runtime_error&) {
    return false;  // refused, with words
  }
}

TEST(ForgedLog_IsSummarizedDrawnAndCutWithoutHarm) {
  const Folder folder;
  const std::string path = folder.name + "/wild.ftl", cut = folder.name + "/cut.ftl";
  Random random(17);
  uint32_t drawn = 0;
  const uint32_t tries = is_long() ? 200000 : 300;
  for (uint32_t i = 0; i < tries; ++i) {
    test::note("try", i);
    const Bytes bytes = wild_log(random);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    is_done([&] {
      log::Reader reader(log::open_file(path), path);
      CHECK(!log::text_of(log::statistics_of(reader)).empty());
    });
    std::string svg, other, page;
    drawn += is_done([&] { svg = log::plot(path, {}, false); });
    is_done([&] { other = log::plot(path, {kNames[random.below(12)]}, false); });
    is_done([&] { page = log::plot(path, {}, true); });
    for (const char* word : {"nan", "inf", "<b>", "</svg>&", "<script>", "\x1b"})
      CHECK((svg + other).find(word) == std::string::npos);

    CHECK(page.find("<b>") == std::string::npos && page.find('\x1b') == std::string::npos);
    is_done([&] { log::cut(path, random.next(), random.next() | 1u << 31, cut); });
    is_done([&] { log::cut(path, 0, log::number_at(path, 1e-5), cut); });
    is_done([&] { log::join({path, path}, cut); });
    if (is_done([&] { log::join({path}, cut); })) {
      log::Reader reader(log::open_file(cut), cut);
      log::read_through(reader);
      CHECK(reader.is_whole());
    }
  }
  CHECK_GE(drawn, tries / 4);
}

}  // namespace
}  // namespace firmtouch::log_test
