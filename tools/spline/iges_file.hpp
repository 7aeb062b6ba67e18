#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "spline/iges_record.hpp"
#include "spline/spline_sink.hpp"

namespace firmtouch::tools {

/// An entry of the directory section: two lines of an IGES file.
struct IgesEntry {
  int64_t type = 0;        // 126, 128, ...
  int64_t parameters = 0;  // the first line of its parameter data, from 1
  int64_t matrix = 0;      // the entry of its transformation, by the number of its line; 0: none
  int64_t parameter_lines = 0;
  bool is_dependent = false;  // physically: what moves its parent moves it, too
  uint64_t line = 0;          // in the file
};

/// An IGES file taken apart into its sections; what its entities mean is read_iges.cpp's.
struct IgesFile {
  struct Line {
    std::string_view text;  // the columns before the section letter
    uint64_t number;        // in the file, from 1
  };
  std::vector<Line> start, global, directory, parameter;
  std::vector<IgesEntry> entries;
  IgesDelimiters delimiters;
  double unit_m = 1;  // metres a unit of the coordinates
};

/// Takes lines apart: 80 columns each, sections in order, sequence numbers without a gap, as many
/// lines as the last one states.
bool split_iges(std::string_view bytes, SplineSink& sink, IgesFile& file);

/// Delimiters and unit: `unit_m`, or where it is 0 what the file says.
bool read_iges_global(SplineSink& sink, double unit_m, IgesFile& file);

bool read_iges_directory(SplineSink& sink, IgesFile& file);

/// The entry whose first line is number `sequence` of the directory, or nullptr.
const IgesEntry* iges_entry(const IgesFile& file, int64_t sequence);

/// "entity 126 in line 14"
std::string name_of(const IgesEntry& entry);

/// The parameter data of an entry, after its type. A pointer that leads nowhere is a defect of the
/// sink; then `is_whole` is false.
IgesRecord parameters_of(const IgesFile& file, const IgesEntry& entry, SplineSink& sink,
                         bool& is_whole);

}  // namespace firmtouch::tools
