#include "cli/npy.hpp"

#include "cli/failure.hpp"

namespace firmtouch::cli {

std::string npy_head(const std::vector<NpyColumn>& columns, uint64_t rows) {
  std::string types;
  for (const NpyColumn& column : columns) {
    std::string name = column.name;
    for (char& letter : name)
      if (letter == '\'' || letter == '\\') letter = '_';  // the text is Python's
    types += "('" + name + "', '" + column.type + "'), ";
  }
  std::string text = "{'descr': [" + types + "], 'fortran_order': False, 'shape': (" +
                     std::to_string(rows) + ",), }";
  constexpr size_t kBefore = 10, kAlignment = 64;
  while ((kBefore + text.size() + 1) % kAlignment != 0) text += ' ';
  text += '\n';
  if (text.size() > UINT16_MAX) fail_input("too many columns for an .npy file: choose some");
  std::string head = "\x93NUMPY\x01";
  head += '\0';
  head += static_cast<char>(text.size() & 0xFF);
  head += static_cast<char>(text.size() >> 8);
  return head + text;
}

}  // namespace firmtouch::cli
