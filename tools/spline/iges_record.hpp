#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace firmtouch::tools {

/// The delimiters of free-format fields, as the global section names them.
struct IgesDelimiters {
  char field = ',';
  char record = ';';
};

/// Fields of one free-format record of an IGES file: numbers, and strings that state their length
/// (5HWIDTH), between delimiters. A field may run on over the end of a line.
class IgesRecord {
 public:
  /// `columns` of each line belong to the record. `lines`: their numbers in the file.
  IgesRecord(std::string text, size_t columns, std::vector<uint64_t> lines)
      : text_(std::move(text)), columns_(columns), lines_(std::move(lines)) {}

  /// The first two fields of a global section, which name the delimiters of all others. Result:
  /// false where they do not.
  bool read_delimiters();
  void set_delimiters(const IgesDelimiters& delimiters) { delimiters_ = delimiters; }
  const IgesDelimiters& delimiters() const { return delimiters_; }

  /// Each reads the next field; a field left out, or beyond the end of the record, keeps `value`.
  /// Result: nullptr, or what is wrong.
  const char* integer(int64_t& value);
  const char* number(double& value);
  const char* string(std::string& value);
  /// The same, but the field must be there.
  const char* needed_integer(int64_t& value);
  const char* needed_number(double& value);

  /// Passes over the fields that are left. Result: nullptr, or what is wrong with the record's end.
  const char* finish();

  /// Line of the field that was read last.
  uint64_t line() const;
  std::string_view field() const { return field_; }

 private:
  // Result: nullptr, or what is wrong. `field_` is empty where the field is left out.
  const char* next();
  const char* next_string();
  void pass_blanks();

  std::string text_;
  size_t columns_;
  std::vector<uint64_t> lines_;
  IgesDelimiters delimiters_;
  size_t at_ = 0, field_at_ = 0;
  std::string_view field_;
  bool ended_ = false, is_string_ = false;
};

}  // namespace firmtouch::tools
