#pragma once
#include <chrono>
#include <memory>
#include <vector>

#include "bake/hull/bake_base_hull.hpp"
#include "bake/hull/bake_hull.hpp"
#include "bench/models.hpp"
#include "firmtouch/hull/refinement.hpp"

namespace firmtouch::bench {

template <class T>
core::Span<T> span(std::vector<T>& items) {
  return {items.data(), static_cast<uint32_t>(items.size())};
}

inline double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// A hull of a model as an asset holds it.
struct Baked {
  std::vector<tools::Section> sections;
  tools::HullBakeReport report;
  hull::View view;
  double seconds = 0;

  Baked(const Model& model, uint32_t faces, uint32_t bits) {
    tools::HullOptions options;
    options.target_faces = faces;
    options.grid_bits = bits;
    const auto begin = std::chrono::steady_clock::now();
    sections = model.sections;
    const auto more = tools::bake_hull(model.view, sections, "model", options, report);
    seconds = seconds_since(begin);
    sections.insert(sections.end(), more.begin(), more.end());
    (void)tools::open_baked(sections, "model", view);
  }
  Baked(const Baked&) = delete;
  Baked& operator=(const Baked&) = delete;
};

/// A shell of one size and a refinement from it, with memory of their own.
struct Refined {
  std::vector<uint32_t> words, bits, splits_made;
  std::vector<hull::Candidate> candidates;
  hull::BaseHull base_hull;
  std::unique_ptr<hull::Refinement> refinement;

  Refined(const hull::View& view, uint32_t base, uint32_t splits, uint32_t crossings)
      : words(tools::cut_base_hull(view, base)),
        bits(hull::bit_words(view.collapse_count())),
        splits_made(splits),
        candidates(crossings) {
    (void)hull::open_base_hull(
        {reinterpret_cast<const uint8_t*>(words.data()), static_cast<uint32_t>(4 * words.size())},
        view, base_hull);
    refinement = std::make_unique<hull::Refinement>(
        view, base_hull, hull::RefinementMemory{span(bits), span(splits_made), span(candidates)});
  }
};

}  // namespace firmtouch::bench
