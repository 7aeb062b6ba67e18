#include "host_sim/report/image.hpp"

#include <algorithm>

#include "firmtouch/core/crc32.hpp"
#include "host_sim/report/deflate.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr uint32_t kBins = 1u << 18;  // 6 bits a channel
constexpr size_t kPalette = 256;

uint32_t bin_of(Colour c) {
  return static_cast<uint32_t>((c.r >> 2) << 12 | (c.g >> 2) << 6 | c.b >> 2);
}

void put_u32(std::string& to, uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(word >> shift & 255u);
}

void chunk(std::string& to, const std::string& type, const std::string& body) {
  put_u32(to, static_cast<uint32_t>(body.size()));
  const std::string checked = type + body;
  to += checked;
  put_u32(to, core::crc32({reinterpret_cast<const uint8_t*>(checked.data()),
                           static_cast<uint32_t>(checked.size())}));
}

uint32_t distance2(Colour a, Colour b) {
  const int r = a.r - b.r, g = a.g - b.g, bl = a.b - b.b;
  return static_cast<uint32_t>(r * r + g * g + bl * bl);
}

struct Palette {
  std::vector<Colour> colours;
  std::vector<uint8_t> index_of_bin;
};

Palette make_palette(const Image& image) {
  struct Bin {
    uint32_t count = 0, r = 0, g = 0, b = 0;
  };
  std::vector<Bin> bins(kBins);
  for (const Colour c : image.pixels) {
    Bin& bin = bins[bin_of(c)];
    ++bin.count, bin.r += c.r, bin.g += c.g, bin.b += c.b;
  }
  std::vector<uint32_t> used;
  for (uint32_t i = 0; i < kBins; ++i)
    if (bins[i].count > 0) used.push_back(i);
  std::stable_sort(used.begin(), used.end(),
                   [&](uint32_t a, uint32_t b) { return bins[a].count > bins[b].count; });
  const auto mean = [&](uint32_t i) {
    const Bin& bin = bins[i];
    return Colour{static_cast<uint8_t>(bin.r / bin.count), static_cast<uint8_t>(bin.g / bin.count),
                  static_cast<uint8_t>(bin.b / bin.count)};
  };
  Palette palette;
  palette.index_of_bin.resize(kBins, 0);
  for (size_t k = 0; k < std::min(used.size(), kPalette); ++k)
    palette.colours.push_back(mean(used[k]));
  for (size_t k = 0; k < used.size(); ++k) {
    size_t best = k;
    if (k >= kPalette) {
      best = 0;
      for (size_t j = 1; j < palette.colours.size(); ++j)
        if (distance2(mean(used[k]), palette.colours[j]) <
            distance2(mean(used[k]), palette.colours[best]))
          best = j;
    }
    palette.index_of_bin[used[k]] = static_cast<uint8_t>(best);
  }
  return palette;
}

}  // namespace

Image halved(const Image& image) {
  Image half(image.width / 2, image.height / 2, {});
  for (uint32_t y = 0; y < half.height; ++y)
    for (uint32_t x = 0; x < half.width; ++x) {
      uint32_t r = 2, g = 2, b = 2;  // rounds to nearest
      for (uint32_t k = 0; k < 4; ++k) {
        const Colour c = image.at(2 * x + (k & 1u), 2 * y + (k >> 1));
        r += c.r, g += c.g, b += c.b;
      }
      half.at(x, y) = {static_cast<uint8_t>(r / 4), static_cast<uint8_t>(g / 4),
                       static_cast<uint8_t>(b / 4)};
    }
  return half;
}

std::string png_of(const Image& image) {
  const Palette palette = make_palette(image);
  std::string header, colours, rows;
  put_u32(header, image.width);
  put_u32(header, image.height);
  header += std::string("\x08\x03\0\0\0", 5);  // 8 bits, indexed
  for (const Colour c : palette.colours)
    for (const uint8_t channel : {c.r, c.g, c.b}) colours += static_cast<char>(channel);
  for (uint32_t y = 0; y < image.height; ++y) {
    rows += '\0';  // no filter: indices are no levels
    for (uint32_t x = 0; x < image.width; ++x)
      rows += static_cast<char>(palette.index_of_bin[bin_of(image.at(x, y))]);
  }
  std::string png = "\x89PNG\r\n\x1a\n";
  chunk(png, "IHDR", header);
  chunk(png, "PLTE", colours);
  chunk(png, "IDAT", zlib_compress(rows));
  chunk(png, "IEND", "");
  return png;
}

std::string base64_of(const void* bytes, size_t count) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const uint8_t* from = static_cast<const uint8_t*>(bytes);
  std::string text;
  text.reserve(count / 3 * 4 + 4);
  for (size_t i = 0; i < count; i += 3) {
    const uint32_t b1 = i + 1 < count ? from[i + 1] : 0, b2 = i + 2 < count ? from[i + 2] : 0;
    const uint32_t word = static_cast<uint32_t>(from[i]) << 16 | b1 << 8 | b2;
    text += kDigits[word >> 18];
    text += kDigits[word >> 12 & 63u];
    text += i + 1 < count ? kDigits[word >> 6 & 63u] : '=';
    text += i + 2 < count ? kDigits[word & 63u] : '=';
  }
  return text;
}

}  // namespace firmtouch::host_sim
