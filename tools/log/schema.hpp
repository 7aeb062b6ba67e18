#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace firmtouch::log {

enum class Type { kU32, kI32, kF32 };

struct Field {
  std::string name;  // "output.force_N"
  std::string unit;  // of value * scale + zero
  double scale = 1;
  double zero = 0;
  Type type = Type::kU32;
  uint32_t count = 1;   // values of four bytes
  uint32_t offset = 0;  // in a record
};

/// One value of a record: a field, or one of several that it holds.
struct Column {
  std::string name;  // "output.force_N[2]"
  const Field* field;
  uint32_t offset;
};

struct Bit {
  std::string field;
  uint32_t bit = 0;
  std::string what;
};

/// What a log says before its first record.
struct Header {
  std::vector<Field> fields;
  std::vector<Bit> bits;
  std::map<std::string, std::string> text;  // everything else: asset, build, parameters, ...
  uint32_t decimation = 1;                  // every so many-th record was to be kept
  uint32_t record_bytes = 0;

  /// Result: nullptr where there is no such field.
  const Field* find(const std::string& name) const;
  /// What bit `bit` of `field` says; "bit N" where the log does not.
  std::string what(const std::string& field, uint32_t bit) const;
  /// Of the named bits that are set in `set`: "enable|drive fault".
  std::string names(const std::string& field, uint32_t set) const;
  std::vector<Column> columns() const;
};

/// Without the characters that command a terminal: for words of a log that may come from anywhere.
std::string printable(std::string text);

/// The text of a log's head: `field` lines, `bit` lines, `decimation`, then `key value` lines in
/// the order of their keys.
std::string text_of(const Header& header);
/// The other way round. Result: an empty string, or what is wrong with which line.
std::string parse(const std::string& text, uint32_t record_bytes, Header& header);

/// Sets the fields' offsets one behind the other. Result: bytes of a record.
uint32_t place(std::vector<Field>& fields);

/// The stored value as text, bit for bit: floats with enough digits to distinguish them all.
std::string stored_text(const Column& column, const uint8_t* record);
/// The value in the field's unit.
double value(const Field& field, uint32_t index, const uint8_t* record);
/// The shortest decimal that is this float: 1e-6, not 9.99999997e-07.
double decimal_of(float number);
uint32_t word(const uint8_t* record, uint32_t offset);

}  // namespace firmtouch::log
