#pragma once
#include <vector>

#include "bench/models.hpp"
#include "lab/orders/build.hpp"
#include "lab/orders/sides.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {

/// The middles of n x n x n voxels of the cube about the model's box.
std::vector<math::Vec3> voxels(const Model& model, uint32_t n);

/// Off every axis, so that models with straight edges are met at random.
constexpr math::Vec3 kRayAlong{0.5773f, 0.6121f, 0.5404f};

/// A tree of kind K over a model, in memory of its own.
template <class K>
class Grown {
 public:
  explicit Grown(const mesh::View& mesh)
      : ranges_(2 * size_t{mesh.nodes().size()}),
        sources_(mesh.nodes().size()),
        nodes_(mesh.nodes().size()),
        middle_(2 * size_t{mesh.nodes().size()}) {
    tree_ =
        orders::build<K>(mesh, {ranges_.data(), sources_.data()}, nodes_.data(), middle_.data());
  }
  Grown(const Grown&) = delete;
  Grown& operator=(const Grown&) = delete;

  const orders::Tree<K>& tree() const { return tree_; }

 private:
  std::vector<orders::Range> ranges_;
  std::vector<uint32_t> sources_;
  std::vector<typename K::Node> nodes_;
  std::vector<uint32_t> middle_;
  orders::Tree<K> tree_;
};

}  // namespace firmtouch::lab
