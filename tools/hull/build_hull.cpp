#include "hull/build_hull.hpp"

#include "surface/check/mending.hpp"
#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

class Builder {
 public:
  Builder(const Surface& surface, const HullOptions& options, HullReport& report)
      : options_(options),
        report_(report),
        mesh_(surface),
        placement_(mesh_, hull_.grid, options.limits, report.counts),
        queue_(make_queue(options.queue, mesh_.edge_count())),
        place_(mesh_.edge_count()),
        is_stale_(mesh_.edge_count(), false),
        stamp_(mesh_.edge_count(), 0) {
    hull_.grid = grid_for(surface, options.grid_bits);
    hull_.mesh_vertices = static_cast<uint32_t>(surface.vertices.size());
    hull_.mesh_faces = surface.faces;
    hull_.removed_by.assign(surface.vertices.size(), kNone);
  }

  ProgressiveHull run() {
    for (uint32_t edge = 0; edge < mesh_.edge_count(); ++edge) evaluate(edge);
    while (mesh_.face_count() > options_.target_faces && !queue_->is_empty()) {
      const uint32_t edge = queue_->pop();
      if (is_stale_[edge] && options_.strategy == HullStrategy::kLazyVolume) {
        evaluate(edge);
        continue;
      }
      if (placement_.may_collapse(edge) && is_placed(edge)) collapse(edge);
    }
    report_.counts.comparisons = queue_->comparisons;
    if (mesh_.face_count() > options_.target_faces) report_stall();
    hull_.vertices_m = mesh_.vertices();
    return std::move(hull_);
  }

 private:
  struct Place {
    math::Vec3 at_m;
    double volume_m3 = 0;
  };

  // Puts the edge into the queue, or takes it out where it may not collapse.
  void evaluate(uint32_t edge) {
    is_stale_[edge] = false;
    if (!placement_.may_collapse(edge)) return queue_->remove(edge);
    if (options_.strategy == HullStrategy::kCentre)
      return queue_->put(edge, placement_.centre_volume_m3());
    Place& place = place_[edge];
    place.volume_m3 = 0;
    if (!placement_.place(place.at_m, place.volume_m3)) return queue_->remove(edge);
    queue_->put(edge, place.volume_m3);
  }

  // The second strategy finds the vertex only now.
  bool is_placed(uint32_t edge) {
    if (options_.strategy != HullStrategy::kCentre) return true;
    Place& place = place_[edge];
    return placement_.place(place.at_m, place.volume_m3);
  }

  void collapse(uint32_t edge) {
    const Star& star = placement_.star();
    const uint32_t number = static_cast<uint32_t>(hull_.collapses.size());
    hull_.collapses.push_back({star.u, star.v, static_cast<uint32_t>(hull_.links.size()),
                               static_cast<uint32_t>(star.link.size()), star.split,
                               place_[edge].volume_m3});
    hull_.links.insert(hull_.links.end(), star.link.begin(), star.link.end());
    hull_.removed_by[star.u] = hull_.removed_by[star.v] = number;
    hull_.removed_by.push_back(kNone);
    gone_.clear();
    mesh_.collapse(star, place_[edge].at_m, gone_);
    for (const uint32_t each : gone_) queue_->remove(each);
    around_ = star.link;
    look_again();
    if (options_.on_progress && hull_.collapses.size() % 1000 == 0)
      options_.on_progress(mesh_.face_count());
  }

  // The faces around every edge that ends in the link have changed.
  void look_again() {
    const uint32_t now = static_cast<uint32_t>(hull_.collapses.size());
    for (const uint32_t vertex : around_) {
      for (const uint32_t edge : mesh_.edges_of(vertex)) {
        if (stamp_[edge] == now) continue;
        stamp_[edge] = now;
        if (options_.strategy != HullStrategy::kLazyVolume || place_[edge].volume_m3 <= 0) {
          evaluate(edge);
          continue;
        }
        // One that was refused comes back at the volume that it had then: else it would never have
        // its turn. Looking at it at once instead cost the horse three times the programs.
        is_stale_[edge] = true;
        if (!queue_->has(edge)) queue_->put(edge, place_[edge].volume_m3);
      }
    }
  }

  // All edges that are left may not collapse: for how many is which test the reason?
  void report_stall() {
    HullCounts why;
    Placement placement(mesh_, hull_.grid, options_.limits, why);
    uint32_t edges = 0, first = kNone;
    for (uint32_t edge = 0; edge < mesh_.edge_count(); ++edge) {
      if (!mesh_.is_edge(edge)) continue;
      if (edges++ == 0) first = edge;
      Place ignored;
      if (placement.may_collapse(edge)) (void)placement.place(ignored.at_m, ignored.volume_m3);
    }
    report_.stalled = "stops at " + counted(mesh_.face_count(), "face", "faces") + " of the " +
                      std::to_string(options_.target_faces) + " requested: none of " +
                      counted(edges, "edge", "edges") + " may collapse (";
    const struct {
      uint64_t count;
      const char* text;
    } kReasons[] = {{why.compactness, "compactness"},
                    {why.deviation, "turned faces"},
                    {why.valence, "valence"},
                    {why.link, "link condition"},
                    {why.unsolvable, "no point outside all faces"},
                    {why.off_grid + why.not_outside, "grid"}};
    bool is_first = true;
    for (const auto& reason : kReasons) {
      if (reason.count == 0) continue;
      report_.stalled +=
          (is_first ? "" : ", ") + std::string(reason.text) + " " + std::to_string(reason.count);
      is_first = false;
    }
    report_.stalled += "); first " + place_of(first) +
                       ": loosen --compactness or --max-deviation-deg, raise --max-valence, or "
                       "request more faces";
  }

  std::string place_of(uint32_t edge) const {
    Star star;
    (void)mesh_.star_of(edge, star);
    Surface now;
    now.vertices = mesh_.vertices();
    return "the edge at " + named_vertex(now, star.u);
  }

  const HullOptions& options_;
  HullReport& report_;
  ProgressiveHull hull_;
  CollapseMesh mesh_;
  Placement placement_;
  std::unique_ptr<CollapseQueue> queue_;
  std::vector<Place> place_;
  std::vector<bool> is_stale_;
  std::vector<uint32_t> stamp_, gone_, around_;
};

}  // namespace

ProgressiveHull build_hull(const Surface& surface, const HullOptions& options, HullReport& report) {
  return Builder(surface, options, report).run();
}

}  // namespace firmtouch::tools
