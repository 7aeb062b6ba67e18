#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Points with lines, triangles and values, as VTK PolyData (.vtp, which ParaView opens).
/// Text, so that any reader of XML reads it; %.9g keeps every bit of a float.
struct PolyData {
  struct Values {
    std::string name;
    uint32_t components = 1;
    std::vector<double> values;  // of each point or, of the whole, of one
  };
  std::vector<Vec> points_m;
  std::vector<std::vector<uint32_t>> verts, lines;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<Values> of_points, of_whole;
};
std::string vtp_of(const PolyData& data);

/// Files by time, as a ParaView collection (.pvd).
struct TimedFile {
  double time_s;
  uint32_t part;
  std::string file;
};
std::string pvd_of(const std::vector<TimedFile>& files);

}  // namespace firmtouch::host_sim
