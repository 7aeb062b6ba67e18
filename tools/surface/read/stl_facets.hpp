#pragma once
#include <cstdint>

#include "surface/point.hpp"
#include "surface/read/import_sink.hpp"

namespace firmtouch::tools {

/// The facets of an STL file, in its order. The winding of the corners counts; the normal stored
/// beside it is only compared with it.
class StlFacets {
 public:
  explicit StlFacets(ImportSink& sink) : sink_(sink) {}

  /// `normal`: as it stands in the file; of length 0 or not finite where there is none.
  /// Result: whether reading goes on.
  bool add(const Point& normal, const Point (&corners)[3], const Place& place);
  uint64_t count() const { return count_; }
  /// Welds what was added and notes what was odd.
  void finish();

 private:
  ImportSink& sink_;
  uint64_t count_ = 0;
  uint64_t opposite_ = 0, oblique_ = 0;  // normals against the winding, and far off it
  uint64_t first_odd_ = 0;
};

/// The two forms of STL. `bytes`: the whole file, which read_stl() found to be of this form.
void read_stl_text(std::string_view text, ImportSink& sink);
void read_stl_binary(std::string_view bytes, ImportSink& sink);

}  // namespace firmtouch::tools
