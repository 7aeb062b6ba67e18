#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::host_sim {

struct Colour {
  uint8_t r = 0, g = 0, b = 0;
};

struct Image {
  Image(uint32_t its_width, uint32_t its_height, Colour background)
      : width(its_width), height(its_height), pixels(size_t{its_width} * its_height, background) {}
  Colour& at(uint32_t x, uint32_t y) { return pixels[size_t{y} * width + x]; }
  const Colour& at(uint32_t x, uint32_t y) const { return pixels[size_t{y} * width + x]; }
  uint32_t width, height;
  std::vector<Colour> pixels;
};

/// Half the width and height: averages 2 x 2 pixels.
Image halved(const Image& image);

/// PNG with a palette of the 256 most frequent colours; other pixels take the nearest of them.
std::string png_of(const Image& image);

std::string base64_of(const void* bytes, size_t count);

}  // namespace firmtouch::host_sim
