#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::log {

/// What befell the logs that were read goes to `troubles`, where it is not null: their whole blocks
/// were taken.

/// Copies the records whose numbers are in [from, to) to a new log. Result: how many. Throws
/// std::runtime_error, and leaves no file, where something cannot be read or written, or none is in
/// that range.
uint64_t cut(const std::string& path, uint64_t from, uint64_t to, const std::string& output,
             std::string* troubles = nullptr);

/// The number of the first record that is `seconds` or more behind the log's first one; behind the
/// last record where none is.
uint64_t number_at(const std::string& path, double seconds);

/// Puts logs of one run one behind the other: the parts that a recorder made, or what cut() made.
/// Throws std::runtime_error, and leaves no file, where they are not of one run or their numbers do
/// not rise. Result: how many records.
uint64_t join(const std::vector<std::string>& paths, const std::string& output,
              std::string* troubles = nullptr);

}  // namespace firmtouch::log
