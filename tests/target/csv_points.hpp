#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::target {

/// Rows x,y,z of a file on the emulator's machine, one at a time. Skips lines without three
/// numbers.
class CsvPoints {
 public:
  explicit CsvPoints(const char* path);
  ~CsvPoints();
  CsvPoints(const CsvPoints&) = delete;
  CsvPoints& operator=(const CsvPoints&) = delete;

  /// Result: false at the end of the file, or if it cannot be read.
  bool next(math::Vec3& point_m);

 private:
  bool read_line();

  int32_t file_;
  uint8_t bytes_[1024];
  uint32_t count_ = 0, at_ = 0;
  char line_[128];
};

}  // namespace firmtouch::target
