#pragma once
#include <map>
#include <string>
#include <vector>

#include "bake/asset/step_figures.hpp"
#include "cli/plan_images.hpp"
#include "firmtouch/asset/container.hpp"

namespace firmtouch::cli {

/// One way to bake the inputs, baked.
struct PlanRow {
  std::vector<std::string> words;  // of bake
  std::string refused;             // by bake, and why; then nothing below counts
  std::vector<std::string> parts;  // that the asset needs
  Image image;                     // the smallest program that has them
  uint64_t asset = 0;              // bytes, as in flash
  uint64_t field = 0, hull = 0;    // of these
  tools::StepFigures work;         // units a query of the meshes takes; 0: there is none
  uint64_t triangles = 0;
  uint64_t spheres = 0;  // of the tool; 0: it has none of its own

  std::string text() const;
  uint64_t flash() const { return image.flash + asset; }
};

/// Bakes the inputs in several ways, best for a controller last, until memory ends.
class Planner {
 public:
  /// `shared`: words of bake that every way has, the inputs among them.
  Planner(std::vector<Image> images, std::vector<std::string> shared, uint64_t flash, uint64_t ram)
      : images_(std::move(images)), shared_(std::move(shared)), flash_(flash), ram_(ram) {}

  /// Fails where bake refuses the inputs.
  void run();

  const std::vector<PlanRow>& rows() const { return rows_; }
  /// The row to take; -1: none fits.
  int chosen() const { return chosen_; }
  /// The row of least flash.
  const PlanRow& least() const;
  bool fits(const PlanRow& row) const {
    return row.refused.empty() && row.flash() <= flash_ && row.image.whole_ram() <= ram_;
  }

 private:
  PlanRow bake(const std::vector<std::string>& words, bool must);
  // Adds a row. Result: whether it is the one to take so far: it fits, and `is_better` than that.
  template <class IsBetter>
  bool try_row(const std::vector<std::string>& words, IsBetter is_better);
  void measure(const asset::Container& container, PlanRow& row);

  std::vector<Image> images_;
  std::vector<std::string> shared_;
  uint64_t flash_, ram_;
  std::vector<PlanRow> rows_;
  int chosen_ = -1;
  std::map<std::string, std::vector<math::Vec3>> walks_;  // of each mesh, the same for all rows
};

}  // namespace firmtouch::cli
