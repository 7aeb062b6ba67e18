#include "target/csv_points.hpp"

#include "emulator/semihosting.hpp"

namespace firmtouch::target {
namespace {

// Decimal to float through double: exact to the last bit, except for digits beyond the 18th.
bool parse(const char*& at, float& value) {
  const bool negative = *at == '-';
  if (*at == '-' || *at == '+') ++at;
  double digits = 0;
  int32_t exponent = 0;
  uint32_t count = 0;
  for (bool fraction = false;; ++at) {
    if (*at == '.' && !fraction) {
      fraction = true;
    } else if (*at >= '0' && *at <= '9') {
      ++count;
      digits = digits * 10 + (*at - '0');
      if (fraction) --exponent;
    } else {
      break;
    }
  }
  if (count == 0) return false;
  if (*at == 'e' || *at == 'E') {
    const bool down = *++at == '-';
    if (*at == '-' || *at == '+') ++at;
    int32_t power = 0;
    for (; *at >= '0' && *at <= '9' && power < 1000; ++at) power = power * 10 + (*at - '0');
    exponent += down ? -power : power;
  }
  double scale = 1;
  for (int32_t i = exponent < 0 ? -exponent : exponent; i > 0; --i) scale *= 10;
  const double result = exponent < 0 ? digits / scale : digits * scale;
  value = static_cast<float>(negative ? -result : result);
  return true;
}

}  // namespace

CsvPoints::CsvPoints(const char* path) : file_(hal::semihosting_open(path, 1)) {}

CsvPoints::~CsvPoints() {
  if (file_ >= 0) hal::semihosting_close(file_);
}

bool CsvPoints::next(math::Vec3& point_m) {
  while (read_line()) {
    const char* at = line_;
    if (!parse(at, point_m.x) || *at++ != ',') continue;
    if (!parse(at, point_m.y) || *at++ != ',') continue;
    if (parse(at, point_m.z)) return true;
  }
  return false;
}

bool CsvPoints::read_line() {
  uint32_t length = 0;
  for (;;) {
    if (at_ == count_) {
      at_ = 0;
      count_ = file_ < 0 ? 0 : hal::semihosting_read(file_, bytes_, sizeof bytes_);
      if (count_ == 0) return false;
    }
    const char c = static_cast<char>(bytes_[at_++]);
    if (c == '\n') break;
    if (length + 1 < sizeof line_) line_[length++] = c;
  }
  line_[length] = 0;
  return true;
}

}  // namespace firmtouch::target
