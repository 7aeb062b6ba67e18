#pragma once
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "bench/bench.hpp"
#include "firmtouch/mesh/view.hpp"
#include "simd/wide_mesh.hpp"
#include "surface/surface.hpp"

namespace firmtouch::bench {

/// A folder of its own for what a peer is to read; it goes with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Writes a file into the folder; result: its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

/// A model checked, mended and baked in memory, opened with the firmware's decoder. The view refers
/// to the sections: a model may be moved, not copied.
struct Model {
  Model() = default;
  Model(Model&&) = default;
  Model& operator=(Model&&) = default;

  std::string name;        // the file's stem
  std::string path;        // "" for the demo part
  tools::Surface surface;  // sound; its faces are not in the order of the tree
  tools::MeshReport report;
  std::vector<tools::Section> sections;
  mesh::View view;
  simd::WideMesh wide;  // the same mesh with the search of this processor

  double diagonal_m() const { return static_cast<double>(view.head().diagonal_m); }
};

/// Whether a bake stores what the sign needs.
enum class Sides { kSigned, kUnsigned };

/// What coordinates count from: the origin that a bake chooses, which is not 0 for a model far from
/// it, or that of the file, which a peer reads, too.
enum class CountedFrom { kOrigin, kFile };

/// What is named, or the demo part (seed 1) where nothing is: throws a Problem with the file, what
/// is wrong and how to mend it.
std::vector<Model> load_models(const Options& options, Sides sides = Sides::kSigned);
Model load_model(const std::string& path, Sides sides = Sides::kSigned,
                 CountedFrom counted = CountedFrom::kOrigin);
Model demo_part(Sides sides = Sides::kSigned, uint32_t triangles = 20000);
Model model_of(tools::Surface surface, const std::string& name, const std::string& path,
               Sides sides, const tools::TreeShape& shape = tools::kFastTree);

/// The same surface baked otherwise.
Model baked_again(const Model& model, Sides sides);
Model baked_for_desktop(const Model& model);

/// The file that a peer is to read: the model's own, or one written into `folder`.
std::string file_for_peer(const Model& model, const TemporaryFolder& folder);

/// Points spread evenly in 1.5 times the model's box.
std::vector<math::Vec3> random_points(const Model& model, size_t count, uint64_t seed = 1);

/// The touching path of `firmtouch make walk MODEL --seed N --points COUNT`.
std::vector<math::Vec3> walk(const Model& model, uint32_t count, uint64_t seed = 1);

}  // namespace firmtouch::bench
