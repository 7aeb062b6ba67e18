#include "cli/rows.hpp"

#include <cstdio>
#include <cstring>

#include "cli/failure.hpp"
#include "json/json.hpp"

namespace firmtouch::cli {

RowPrinter::RowPrinter(std::vector<NpyColumn> columns, const Arguments& arguments)
    : format_(arguments.has("--npy")    ? Format::kNpy
              : arguments.has("--json") ? Format::kJson
                                        : Format::kCsv),
      columns_(std::move(columns)) {
  if (format_ != Format::kCsv) return;
  for (const NpyColumn& column : columns_) text_ += (text_.empty() ? "" : ",") + column.name;
  std::puts(text_.c_str());
  text_.clear();
}

void RowPrinter::put_text(const std::string& csv, const std::string& json) {
  const char* const comma = next_ == 0 ? "" : format_ == Format::kCsv ? "," : ", ";
  text_ += comma;
  if (format_ == Format::kJson) text_ += "\"" + columns_[next_].name + "\": ";
  text_ += format_ == Format::kCsv ? csv : json;
  ++next_;
}

void RowPrinter::put_number(double value, const void* bytes, size_t size) {
  if (format_ == Format::kNpy) {
    text_.append(static_cast<const char*>(bytes), size);
    return;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  put_text(text, tools::json_number(value));
}

void RowPrinter::put(bool value) {
  if (format_ == Format::kNpy)
    text_ += value ? '\1' : '\0';
  else
    put_text(value ? "1" : "0", value ? "true" : "false");
}

void RowPrinter::put(int64_t value) {
  if (format_ == Format::kNpy)
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  else
    put_text(std::to_string(value), std::to_string(value));
}

// At most eight letters of ASCII, 4 bytes each in an .npy.
void RowPrinter::put(const char* text) {
  if (format_ != Format::kNpy) return put_text(text, tools::json_text(text));
  const size_t length = std::strlen(text);
  for (size_t i = 0; i < 8; ++i) {
    text_ += i < length ? text[i] : '\0';
    text_.append(3, '\0');
  }
}

void RowPrinter::end_row() {
  ++rows_;
  next_ = 0;
  if (format_ == Format::kNpy) return;
  std::printf(format_ == Format::kJson ? "{%s}\n" : "%s\n", text_.c_str());
  text_.clear();
}

void RowPrinter::finish() {
  if (format_ != Format::kNpy) return;
  const std::string head = npy_head(columns_, rows_);
  std::fwrite(head.data(), 1, head.size(), stdout);
  std::fwrite(text_.data(), 1, text_.size(), stdout);
}

}  // namespace firmtouch::cli
