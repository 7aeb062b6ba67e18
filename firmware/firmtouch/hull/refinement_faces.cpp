#include "firmtouch/hull/refinement.hpp"
#include "firmtouch/hull/vertices.hpp"

namespace firmtouch::hull {

bool Refinement::Faces::next() {
  const View& hull = of_.hull_;
  const uint32_t mesh_vertices = hull.head().mesh_vertex_count;
  // The base hull's faces first (at_ == 0), then the stars of what is split back.
  while (at_ <= of_.count_) {
    const uint32_t face = face_++;
    if (at_ == 0) {
      if (face == of_.base_hull_.face_count()) {
        face_ = 0;
        ++at_;
        continue;
      }
      for (uint32_t k = 0; k < 3; ++k)
        number[k] = hull.number_of(of_.base_hull_.id_of(of_.base_hull_.vertex_of(face, k)));
    } else {
      const uint32_t collapse = of_.memory_.splits[at_ - 1];
      const Star star(hull, collapse, hull.record(collapse));
      if (face == star.face_count()) {
        face_ = 0;
        ++at_;
        continue;
      }
      uint32_t corner[3];
      star.face(face, corner);
      for (uint32_t k = 0; k < 3; ++k) number[k] = star.number[corner[k]];
    }
    uint32_t youngest = number[0];
    if (number[1] > youngest) youngest = number[1];
    if (number[2] > youngest) youngest = number[2];
    if (youngest < mesh_vertices || !of_.is_split(youngest - mesh_vertices)) return true;
  }
  return false;
}

}  // namespace firmtouch::hull
