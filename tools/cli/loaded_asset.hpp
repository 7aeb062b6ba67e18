#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/spline/view.hpp"
#include "simd/wide_mesh.hpp"
#include "surface/point.hpp"

namespace firmtouch::cli {

struct LoadedMesh {
  simd::WideMesh wide;                // the answers of the controller, to the bit
  core::Span<const uint32_t> source;  // of each triangle: its index in the imported file

  uint32_t source_of(uint32_t triangle) const {
    return triangle < source.size() ? source[triangle] : triangle;
  }
};

struct LoadedHull {
  hull::View view;
  core::Span<const uint32_t> source;  // of each triangle: its index in the imported file

  uint32_t source_of(uint32_t triangle) const {
    return triangle < source.size() ? source[triangle] : triangle;
  }
};

struct LoadedCurve {
  curve::Sections sections;
  curve::View view;
  core::Span<const uint32_t> rows;  // of each sample: its row in the imported file

  uint32_t row_of(uint32_t sample) const { return sample < rows.size() ? rows[sample] : sample; }
};

/// An asset file read whole and opened with the firmware's decoder. Fails (bad input) with the
/// file, the rule that it breaks and where.
class LoadedAsset {
 public:
  explicit LoadedAsset(const std::string& path);
  LoadedAsset(const LoadedAsset&) = delete;
  LoadedAsset& operator=(const LoadedAsset&) = delete;

  const std::string& path() const { return path_; }
  const asset::Container& container() const { return container_; }
  tools::Point origin_m() const { return tools::to_point(container_.origin_m()); }
  /// Fails (bad input) where there is none of this name: the message says which there are.
  LoadedMesh mesh(const std::string& name) const;
  LoadedHull hull(const std::string& name) const;
  LoadedCurve curve(const std::string& name) const;
  spline::View spline(const std::string& name) const;

 private:
  [[noreturn]] void fail_unsound(const std::string& what) const;
  [[noreturn]] void fail_absent(const std::string& kind, const std::string& name) const;

  std::string path_;
  std::vector<uint8_t> bytes_;
  asset::Container container_;
};

}  // namespace firmtouch::cli
