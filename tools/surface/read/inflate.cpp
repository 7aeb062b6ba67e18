#include "surface/read/inflate.hpp"

#include <array>
#include <cstdint>

#include "firmtouch/core/crc32.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint32_t kMaxBits = 15, kRootBits = 10;
constexpr uint32_t kNoSymbol = 0xFFFF;

// Bits from the least significant of each byte. Behind the end come zeros; `is_over` then.
class Bits {
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}

  uint32_t peek(uint32_t count) {
    while (held_ < count) {
      const size_t at = next_++;
      if (at < bytes_.size()) hold_ |= uint64_t{static_cast<uint8_t>(bytes_[at])} << held_;
      held_ += 8;
    }
    return static_cast<uint32_t>(hold_ & ((uint64_t{1} << count) - 1));
  }
  void drop(uint32_t count) {
    hold_ >>= count;
    held_ -= count;
  }
  uint32_t take(uint32_t count) {
    const uint32_t value = peek(count);
    drop(count);
    return value;
  }
  void align() { drop(held_ % 8); }
  bool is_over() const { return used() > bytes_.size(); }
  size_t used() const { return next_ - held_ / 8; }

 private:
  std::string_view bytes_;
  size_t next_ = 0;
  uint64_t hold_ = 0;
  uint32_t held_ = 0;
};

// A canonical prefix code: short codes by a table, longer ones length by length.
class Code {
 public:
  // Result: false where the lengths are no code. One code of one bit is allowed to stand alone.
  bool build(const uint8_t* lengths, uint32_t symbols) {
    count_.fill(0);
    root_.fill({kNoSymbol, 0});
    for (uint32_t s = 0; s < symbols; ++s) ++count_[lengths[s]];
    count_[0] = 0;
    int32_t left = 1;
    uint32_t used = 0;
    for (uint32_t bits = 1; bits <= kMaxBits; ++bits) {
      left = 2 * left - static_cast<int32_t>(count_[bits]);
      used += count_[bits];
      if (left < 0) return false;
    }
    if (left > 0 && used > 1) return false;
    std::array<uint32_t, kMaxBits + 2> first{}, place{};
    for (uint32_t bits = 1; bits <= kMaxBits; ++bits) {
      first[bits + 1] = (first[bits] + count_[bits]) << 1;
      place[bits + 1] = place[bits] + count_[bits];
    }
    first_ = first;
    place_ = place;
    std::array<uint32_t, kMaxBits + 2> next = place;
    for (uint32_t s = 0; s < symbols; ++s) {
      const uint32_t bits = lengths[s];
      if (bits == 0) continue;
      const uint32_t code = first[bits] + next[bits] - place[bits];
      symbol_[next[bits]++] = static_cast<uint16_t>(s);
      if (bits > kRootBits) continue;
      for (uint32_t high = 0; high < 1u << (kRootBits - bits); ++high)
        root_[reversed(code, bits) | high << bits] = {static_cast<uint16_t>(s),
                                                      static_cast<uint8_t>(bits)};
    }
    return true;
  }

  uint32_t read(Bits& in) const {
    const uint32_t window = in.peek(kMaxBits);
    const Entry& entry = root_[window & ((1u << kRootBits) - 1)];
    if (entry.bits != 0) return in.drop(entry.bits), entry.symbol;
    uint32_t code = reversed(window, kRootBits);
    for (uint32_t bits = kRootBits + 1; bits <= kMaxBits; ++bits) {
      code = code << 1 | (window >> (bits - 1) & 1u);
      const uint32_t index = code - first_[bits];
      if (code >= first_[bits] && index < count_[bits])
        return in.drop(bits), symbol_[place_[bits] + index];
    }
    return kNoSymbol;
  }

 private:
  struct Entry {
    uint16_t symbol;
    uint8_t bits;
  };
  static uint32_t reversed(uint32_t value, uint32_t bits) {
    uint32_t turned = 0;
    for (uint32_t k = 0; k < bits; ++k) turned |= (value >> k & 1u) << (bits - 1 - k);
    return turned;
  }

  std::array<uint32_t, kMaxBits + 1> count_{};
  std::array<uint32_t, kMaxBits + 2> first_{}, place_{};
  std::array<uint16_t, 288> symbol_{};
  std::array<Entry, 1u << kRootBits> root_{};
};

struct Codes {
  Code literal, distance;
};

void fixed_codes(Codes& codes) {
  uint8_t lengths[288];
  for (uint32_t s = 0; s < 288; ++s)
    lengths[s] = static_cast<uint8_t>(s < 144 ? 8 : s < 256 ? 9 : s < 280 ? 7 : 8);
  codes.literal.build(lengths, 288);
  for (uint32_t s = 0; s < 32; ++s) lengths[s] = 5;
  codes.distance.build(lengths, 32);
}

const char* read_codes(Bits& in, Codes& codes) {
  static constexpr uint8_t kOrder[19] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                         11, 4,  12, 3, 13, 2, 14, 1, 15};
  const uint32_t literals = in.take(5) + 257, distances = in.take(5) + 1, kinds = in.take(4) + 4;
  uint8_t lengths[288 + 32] = {};
  for (uint32_t k = 0; k < kinds; ++k) lengths[kOrder[k]] = static_cast<uint8_t>(in.take(3));
  if (literals > 286 || distances > 30 || !codes.literal.build(lengths, 19)) return "a bad code";
  uint8_t all[288 + 32] = {};
  for (uint32_t at = 0; at < literals + distances;) {
    const uint32_t kind = codes.literal.read(in);
    if (kind == kNoSymbol || in.is_over()) return "a bad code";
    uint32_t times = 1, value = kind;
    if (kind >= 16) {
      times = kind == 16 ? 3 + in.take(2) : kind == 17 ? 3 + in.take(3) : 11 + in.take(7);
      if (kind == 16 && at == 0) return "a bad code";
      value = kind == 16 ? all[at - 1] : 0;
    }
    if (at + times > literals + distances) return "a bad code";
    for (; times > 0; --times) all[at++] = static_cast<uint8_t>(value);
  }
  if (!codes.literal.build(all, literals) || !codes.distance.build(all + literals, distances))
    return "a bad code";
  return nullptr;
}

const char* read_block(Bits& in, const Codes& codes, std::string& out, size_t max_bytes) {
  static constexpr uint16_t kLength[29] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                           15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                           67, 83, 99, 115, 131, 163, 195, 227, 258};
  for (;;) {
    const uint32_t symbol = codes.literal.read(in);
    if (in.is_over()) return "it is cut short";
    if (symbol == 256) return nullptr;
    if (symbol > 285) return "a bad symbol";
    if (symbol < 256) {
      if (out.size() >= max_bytes) return "too much comes out";
      out.push_back(static_cast<char>(symbol));
      continue;
    }
    const uint32_t l = symbol - 257;
    const uint32_t length = kLength[l] + in.take(l < 8 || l == 28 ? 0 : l / 4 - 1);
    const uint32_t d = codes.distance.read(in);
    if (d > 29) return "a bad symbol";
    const uint32_t more = d < 4 ? 0 : d / 2 - 1;
    const size_t back = (d < 4 ? d : (2 + d % 2) << more) + 1 + in.take(more);
    if (back > out.size()) return "it refers to bytes before its beginning";
    if (length > max_bytes - out.size()) return "too much comes out";
    for (uint32_t k = 0; k < length; ++k) out.push_back(out[out.size() - back]);
  }
}

const char* read_stored(Bits& in, std::string& out, size_t max_bytes) {
  in.align();
  const uint32_t length = in.take(16);
  if ((length ^ in.take(16)) != 0xFFFF) return "a bad length";
  if (length > max_bytes - out.size()) return "too much comes out";
  for (uint32_t k = 0; k < length && !in.is_over(); ++k)
    out.push_back(static_cast<char>(in.take(8)));
  return in.is_over() ? "it is cut short" : nullptr;
}

uint32_t word(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (uint32_t k = 4; k-- > 0;) value = value << 8 | static_cast<uint8_t>(bytes[at + k]);
  return value;
}

// Result: the length of a member's header, or 0.
size_t gzip_header(std::string_view bytes) {
  if (!is_gzip(bytes) || bytes.size() < 18 || bytes[2] != 8) return 0;
  const uint32_t flags = static_cast<uint8_t>(bytes[3]);
  size_t at = 10;
  if ((flags & 4) != 0)
    at +=
        2 + size_t{static_cast<uint8_t>(bytes[10])} + 256 * size_t{static_cast<uint8_t>(bytes[11])};
  for (const uint32_t text : {8u, 16u}) {
    if ((flags & text) == 0) continue;
    const size_t end = bytes.find('\0', at);
    if (end == bytes.npos) return 0;
    at = end + 1;
  }
  if ((flags & 2) != 0) at += 2;
  return at < bytes.size() ? at : 0;
}

}  // namespace

Inflated inflate(std::string_view deflated, size_t max_bytes) {
  Inflated result;
  Bits in(deflated);
  Codes codes;
  const char* wrong = nullptr;
  for (bool is_last = false; wrong == nullptr && !is_last;) {
    is_last = in.take(1) != 0;
    const uint32_t kind = in.take(2);
    if (kind == 0) {
      wrong = read_stored(in, result.bytes, max_bytes);
    } else if (kind == 3) {
      wrong = "a bad block";
    } else {
      if (kind == 1) fixed_codes(codes);
      if (kind == 2) wrong = read_codes(in, codes);
      if (wrong == nullptr) wrong = read_block(in, codes, result.bytes, max_bytes);
    }
    if (wrong == nullptr && in.is_over()) wrong = "it is cut short";
  }
  if (wrong != nullptr) return {{}, wrong, 0};
  result.used = in.used();
  return result;
}

bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1F\x8B"; }

Inflated gunzip(std::string_view bytes, size_t max_bytes) {
  Inflated all;
  do {
    const size_t header = gzip_header(bytes);
    if (header == 0) return {{}, "a bad header", 0};
    const Inflated one = inflate(bytes.substr(header), max_bytes - all.bytes.size());
    if (!one.problem.empty()) return one;
    const size_t end = header + one.used;
    if (bytes.size() < end + 8) return {{}, "it is cut short", 0};
    const core::Bytes span(reinterpret_cast<const uint8_t*>(one.bytes.data()),
                           static_cast<uint32_t>(one.bytes.size()));
    if (word(bytes, end) != core::crc32(span) ||
        word(bytes, end + 4) != static_cast<uint32_t>(one.bytes.size()))
      return {{}, "its check sum differs", 0};
    all.bytes += one.bytes;
    all.used += end + 8;
    bytes.remove_prefix(end + 8);
  } while (is_gzip(bytes));
  return all;
}

}  // namespace firmtouch::tools
