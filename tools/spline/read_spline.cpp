#include "spline/read_spline.hpp"

#include "spline/spline_sink.hpp"
#include "surface/read/load_file.hpp"

namespace firmtouch::tools {
SplineModel read_spline_bytes(std::string_view bytes, const std::string& path, double unit_m) {
  SplineSink sink(path);
  const std::string extension = extension_of(path);
  if (bytes.empty()) {
    sink.fail("is empty: export the model again");
  } else if (extension == "igs" || extension == "iges") {
    read_iges(bytes, unit_m, sink);
  } else if (extension == "bpt") {
    read_bpt(bytes, unit_m > 0 ? unit_m : 1.0, sink);
  } else {
    sink.fail("`" + extension +
              "` is no extension of splines: give a file that ends in .igs, .iges or .bpt");
  }
  return sink.finish();
}

SplineModel read_spline_file(const std::string& path, double unit_m) {
  const LoadedFile file = load_file(path, kMaxLineBytes);
  if (!file.problem.empty()) {
    SplineModel refused;
    refused.problem = path + ": " + file.problem;
    return refused;
  }
  const char* bytes = reinterpret_cast<const char*>(file.bytes.data());
  return read_spline_bytes({bytes, file.bytes.size()}, path, unit_m);
}

}  // namespace firmtouch::tools
