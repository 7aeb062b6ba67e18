#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::cli {

struct NpyColumn {
  std::string name;
  const char* type;  // of NumPy: "<f4"
};

/// What stands before the records of an .npy file: `rows` records of these columns, packed.
/// numpy.load() gives an array whose fields have their names.
/// Source: NumPy, numpy.lib.format, version 1.0.
std::string npy_head(const std::vector<NpyColumn>& columns, uint64_t rows);

}  // namespace firmtouch::cli
