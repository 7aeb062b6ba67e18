#include "host_sim/report/deflate.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <queue>
#include <utility>
#include <vector>

namespace firmtouch::host_sim {
namespace {

constexpr size_t kWindow = 32768, kMaxMatch = 258, kMinMatch = 3;
constexpr int kMaxChain =
    64;  // candidates looked at for a match; more gained less than 1 % on our pictures
constexpr uint32_t kHashBits = 15;

constexpr uint16_t kLengthBase[29] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                      15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                      67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr uint8_t kLengthExtra[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                      2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr uint16_t kDistanceBase[30] = {
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
constexpr uint8_t kCodeOrder[19] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                    11, 4,  12, 3, 13, 2, 14, 1, 15};

struct Token {
  uint16_t literal_or_length;  // below 256: a byte; else 257 + length code
  uint16_t distance_code = 0, length_bits = 0, distance_bits = 0;
};

class BitWriter {
 public:
  explicit BitWriter(std::string& to) : to_(to) {}
  void bits(uint32_t value, int count) {
    for (int i = 0; i < count; ++i) {
      byte_ |= ((value >> i) & 1u) << filled_;
      if (++filled_ == 8) flush();
    }
  }
  void code(uint32_t value, int count) {  // Huffman codes go most significant bit first
    for (int i = count - 1; i >= 0; --i) bits((value >> i) & 1u, 1);
  }
  void flush() {
    if (filled_ == 0) return;
    to_ += static_cast<char>(byte_);
    byte_ = 0, filled_ = 0;
  }

 private:
  std::string& to_;
  uint32_t byte_ = 0;
  int filled_ = 0;
};

int distance_extra(uint32_t code) { return code < 4 ? 0 : static_cast<int>(code / 2) - 1; }

// Lengths of a Huffman code of at most `limit` bits: the counts are flattened until it fits.
std::vector<uint8_t> code_lengths(std::vector<uint32_t> counts, int limit) {
  for (;;) {
    using Item = std::pair<uint64_t, uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> heap;
    std::vector<uint32_t> parent(2 * counts.size(), 0);
    for (uint32_t i = 0; i < counts.size(); ++i)
      if (counts[i] > 0) heap.push({counts[i], i});
    std::vector<uint8_t> lengths(counts.size(), 0);
    if (heap.size() == 1) lengths[heap.top().second] = 1;
    if (heap.size() < 2) return lengths;
    uint32_t next = static_cast<uint32_t>(counts.size());
    while (heap.size() > 1) {
      const Item a = heap.top();
      heap.pop();
      const Item b = heap.top();
      heap.pop();
      parent[a.second] = parent[b.second] = next;
      heap.push({a.first + b.first, next++});
    }
    const uint32_t root = next - 1;
    int longest = 0;
    for (uint32_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      int depth = 0;
      for (uint32_t at = i; at != root; at = parent[at]) ++depth;
      lengths[i] = static_cast<uint8_t>(depth);
      longest = std::max(longest, depth);
    }
    if (longest <= limit) return lengths;
    for (uint32_t& count : counts) count = count > 0 ? count / 2 + 1 : 0;
  }
}

std::vector<uint32_t> canonical_codes(const std::vector<uint8_t>& lengths) {
  std::array<uint32_t, 17> count{}, next{};
  for (const uint8_t length : lengths) ++count[length];
  count[0] = 0;
  for (size_t bits = 1; bits <= 15; ++bits) next[bits + 1] = (next[bits] + count[bits]) << 1;
  std::vector<uint32_t> codes(lengths.size(), 0);
  for (size_t i = 0; i < lengths.size(); ++i)
    if (lengths[i] > 0) codes[i] = next[lengths[i]]++;
  return codes;
}

Token match_token(size_t length, size_t distance) {
  const size_t l = static_cast<size_t>(std::upper_bound(kLengthBase, kLengthBase + 29, length) -
                                       kLengthBase - 1);
  const size_t d = static_cast<size_t>(
      std::upper_bound(kDistanceBase, kDistanceBase + 30, distance) - kDistanceBase - 1);
  return {static_cast<uint16_t>(257 + l), static_cast<uint16_t>(d),
          static_cast<uint16_t>(length - kLengthBase[l]),
          static_cast<uint16_t>(distance - kDistanceBase[d])};
}

std::vector<Token> find_matches(const std::string& bytes) {
  std::vector<Token> tokens;
  std::vector<int64_t> head(1u << kHashBits, -1), before(bytes.size(), -1);
  const auto byte = [&](size_t i) { return static_cast<uint32_t>(static_cast<uint8_t>(bytes[i])); };
  const auto enter = [&](size_t i) {
    if (i + kMinMatch > bytes.size()) return;
    const uint32_t key =
        (byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16) * 2654435761u >> (32 - kHashBits);
    before[i] = head[key];
    head[key] = static_cast<int64_t>(i);
  };
  for (size_t i = 0; i < bytes.size();) {
    enter(i);
    size_t best = 0, distance = 0;
    int64_t candidate = before[i];
    const size_t most = std::min(kMaxMatch, bytes.size() - i);
    for (int chain = 0; candidate >= 0 && chain < kMaxChain && best < most;
         ++chain, candidate = before[static_cast<size_t>(candidate)]) {
      const size_t at = static_cast<size_t>(candidate);
      if (i - at > kWindow) break;
      size_t length = 0;
      while (length < most && bytes[at + length] == bytes[i + length]) ++length;
      if (length > best) best = length, distance = i - at;
    }
    if (best < kMinMatch) {
      tokens.push_back({static_cast<uint16_t>(byte(i++))});
      continue;
    }
    tokens.push_back(match_token(best, distance));
    for (size_t k = 1; k < best; ++k) enter(i + k);
    i += best;
  }
  tokens.push_back({256});
  return tokens;
}

void write_block(BitWriter& out, const std::vector<Token>& tokens) {
  std::vector<uint32_t> counts(286, 0), distance_counts(30, 0), order_counts(19, 0);
  for (const Token& token : tokens) {
    ++counts[token.literal_or_length];
    if (token.literal_or_length > 256) ++distance_counts[token.distance_code];
  }
  const std::vector<uint8_t> lengths = code_lengths(counts, 15);
  std::vector<uint8_t> distances = code_lengths(distance_counts, 15);
  if (std::all_of(distances.begin(), distances.end(), [](uint8_t l) { return l == 0; }))
    distances[0] = 1;
  std::vector<uint8_t> both = lengths;
  both.insert(both.end(), distances.begin(), distances.end());
  for (const uint8_t length : both) ++order_counts[length];
  const std::vector<uint8_t> order = code_lengths(order_counts, 7);
  const std::vector<uint32_t> codes = canonical_codes(lengths),
                              distance_codes = canonical_codes(distances),
                              order_codes = canonical_codes(order);
  out.bits(1, 1);  // the last block
  out.bits(2, 2);  // with its own codes
  out.bits(286 - 257, 5);
  out.bits(30 - 1, 5);
  out.bits(19 - 4, 4);
  for (const uint8_t symbol : kCodeOrder) out.bits(order[symbol], 3);
  for (const uint8_t length : both) out.code(order_codes[length], order[length]);
  for (const Token& token : tokens) {
    out.code(codes[token.literal_or_length], lengths[token.literal_or_length]);
    if (token.literal_or_length <= 256) continue;
    out.bits(token.length_bits, kLengthExtra[token.literal_or_length - 257]);
    out.code(distance_codes[token.distance_code], distances[token.distance_code]);
    out.bits(token.distance_bits, distance_extra(token.distance_code));
  }
  out.flush();
}

}  // namespace

std::string zlib_compress(const std::string& bytes) {
  std::string out = "\x78\x9c";
  BitWriter writer(out);
  write_block(writer, find_matches(bytes));
  uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : bytes) {
    a = (a + static_cast<uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  for (const uint32_t byte : {b >> 8, b & 255u, a >> 8, a & 255u}) out += static_cast<char>(byte);
  return out;
}

}  // namespace firmtouch::host_sim
