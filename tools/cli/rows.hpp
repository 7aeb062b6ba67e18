#pragma once
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/npy.hpp"

namespace firmtouch::cli {

/// Rows on standard output: CSV, with --json a JSON object a line, with --npy a NumPy file.
/// Numbers print with nine digits; one that is not finite is null in JSON.
class RowPrinter {
 public:
  RowPrinter(std::vector<NpyColumn> columns, const Arguments& arguments);
  void put(float value) { put_number(static_cast<double>(value), &value, sizeof value); }
  void put(double value) { put_number(value, &value, sizeof value); }
  void put(bool value);
  void put(int64_t value);
  void put(const char* text);
  void end_row();
  /// Writes the .npy, whose head has the count of its rows.
  void finish();

 private:
  enum class Format { kCsv, kJson, kNpy };
  void put_number(double value, const void* bytes, size_t size);
  void put_text(const std::string& csv, const std::string& json);

  Format format_;
  std::vector<NpyColumn> columns_;
  std::string text_;  // the row's; in an .npy all records
  size_t next_ = 0;   // column
  uint64_t rows_ = 0;
};

template <class T>
constexpr const char* npy_type() {
  if (std::is_same_v<T, bool>) return "|b1";
  if (std::is_same_v<T, float>) return "<f4";
  if (std::is_same_v<T, double>) return "<f8";
  return std::is_integral_v<T> ? "<i8" : "<U8";
}

/// Rows that are tuples of one type.
template <class Tuple>
class Rows;
template <class... T>
class Rows<std::tuple<T...>> {
 public:
  /// `names`: a name a column.
  Rows(const char* const (&names)[sizeof...(T)], const Arguments& arguments)
      : printer_(columns(names), arguments) {}
  void add(const std::tuple<T...>& row) {
    std::apply([&](const T&... value) { (put(value), ...); }, row);
    printer_.end_row();
  }
  void finish() { printer_.finish(); }

 private:
  static std::vector<NpyColumn> columns(const char* const (&names)[sizeof...(T)]) {
    std::vector<NpyColumn> list;
    const char* const* name = names;
    (list.push_back({*name++, npy_type<T>()}), ...);
    return list;
  }
  template <class U>
  void put(const U& value) {
    if constexpr (std::is_integral_v<U> && !std::is_same_v<U, bool>)
      printer_.put(static_cast<int64_t>(value));
    else
      printer_.put(value);
  }
  RowPrinter printer_;
};

}  // namespace firmtouch::cli
