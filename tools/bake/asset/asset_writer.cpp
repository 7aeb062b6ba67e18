#include "bake/asset/asset_writer.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "firmtouch/asset/layout.hpp"
#include "firmtouch/core/crc32.hpp"

namespace firmtouch::tools {
namespace {

static_assert(__STDCPP_DEFAULT_NEW_ALIGNMENT__ >= asset::kAlignment,
              "a vector's bytes must be aligned as an asset is");

bool before(const Section& a, const Section& b) {
  if (a.name != b.name) {
    return std::lexicographical_compare(
        a.name.begin(), a.name.end(), b.name.begin(), b.name.end(), [](char x, char y) {
          return static_cast<unsigned char>(x) < static_cast<unsigned char>(y);
        });
  }
  return a.type < b.type;
}

uint64_t rounded_up(uint64_t bytes) {
  return (bytes + asset::kAlignment - 1) / asset::kAlignment * asset::kAlignment;
}

uint32_t crc_of(const uint8_t* bytes, uint64_t count) {
  return core::crc32({bytes, static_cast<uint32_t>(count)});
}

std::string problem_of(const std::vector<Section>& sorted) {
  uint64_t total = sizeof(asset::Header) + sorted.size() * sizeof(asset::Entry);
  for (size_t i = 0; i < sorted.size(); ++i) {
    const Section& section = sorted[i];
    const std::string named = name_problem(section.name);
    if (!named.empty()) return named;
    if (section.bytes.empty()) {
      return "'" + section.name + "': section " + std::to_string(section.type) +
             " is empty; leave it out";
    }
    if (i > 0 && !before(sorted[i - 1], section)) {
      return "'" + section.name + "': two sections of type " + std::to_string(section.type) +
             "; give each asset its own name";
    }
    total += rounded_up(section.bytes.size());
  }
  if (total > std::numeric_limits<uint32_t>::max()) {
    return "the asset would need " + std::to_string(total) +
           " bytes, more than 4 GiB; bake fewer inputs into it";
  }
  return "";
}

}  // namespace

std::string name_problem(const std::string& name) {
  if (name.empty()) return "the asset's name is empty; rename the input file";
  if (name.size() >= asset::kNameBytes) {
    return "'" + name + "': the name has " + std::to_string(name.size()) + " bytes, at most " +
           std::to_string(asset::kNameBytes - 1) + " fit; rename the input file";
  }
  for (const char letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x20 || code == 0x7F)
      return "'" + name + "': the name holds a control character; rename the input file";
  }
  return "";
}

AssetFile write_asset(std::vector<Section> sections) {
  std::stable_sort(sections.begin(), sections.end(), before);
  AssetFile file;
  file.problem = problem_of(sections);
  if (!file.problem.empty()) return file;

  std::vector<asset::Entry> entries;
  uint64_t offset = sizeof(asset::Header) + sections.size() * sizeof(asset::Entry);
  for (const Section& section : sections) {
    asset::Entry entry{};
    entry.type = section.type;
    entry.offset = static_cast<uint32_t>(offset);
    entry.bytes = static_cast<uint32_t>(section.bytes.size());
    entry.crc = crc_of(section.bytes.data(), section.bytes.size());
    std::memcpy(entry.name, section.name.data(), section.name.size());
    entries.push_back(entry);
    offset += rounded_up(section.bytes.size());
  }
  asset::Header header{};
  header.magic = asset::kMagic;
  header.byte_order = asset::kByteOrder;
  header.major = asset::kMajor;
  header.minor = asset::kMinor;
  header.total_bytes = static_cast<uint32_t>(offset);
  header.section_count = static_cast<uint32_t>(entries.size());

  file.bytes.assign(offset, 0);
  std::memcpy(file.bytes.data(), &header, sizeof(header));
  for (size_t i = 0; i < entries.size(); ++i) {
    std::memcpy(file.bytes.data() + sizeof(header) + i * sizeof(asset::Entry), &entries[i],
                sizeof(asset::Entry));
    std::memcpy(file.bytes.data() + entries[i].offset, sections[i].bytes.data(),
                sections[i].bytes.size());
  }
  repair_crcs(file.bytes);
  return file;
}

void repair_crcs(std::vector<uint8_t>& file) {
  if (file.size() < sizeof(asset::Header)) return;
  asset::Header header;
  std::memcpy(&header, file.data(), sizeof(header));
  const uint64_t fit = (file.size() - sizeof(header)) / sizeof(asset::Entry);
  if (header.section_count <= fit) {
    for (uint32_t i = 0; i < header.section_count; ++i) {
      uint8_t* place = file.data() + sizeof(header) + i * sizeof(asset::Entry);
      asset::Entry entry;
      std::memcpy(&entry, place, sizeof(entry));
      if (uint64_t{entry.offset} + entry.bytes > file.size()) continue;
      entry.crc = crc_of(file.data() + entry.offset, entry.bytes);
      std::memcpy(place, &entry, sizeof(entry));
    }
    header.table_crc =
        crc_of(file.data() + sizeof(header), header.section_count * sizeof(asset::Entry));
  }
  std::memcpy(file.data(), &header, sizeof(header));
  header.header_crc = crc_of(file.data(), offsetof(asset::Header, header_crc));
  std::memcpy(file.data(), &header, sizeof(header));
}

}  // namespace firmtouch::tools
