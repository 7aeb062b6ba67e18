#pragma once
#include "firmtouch/hull/refinement.hpp"
#include "firmtouch/hull/vertices.hpp"

namespace firmtouch::hull_test {

/// The faces of a refinement's hull as it is now, one by one, as vertex numbers:
///     for (RefinementFaces f(hull, base_hull, refinement); f.next();) use(f.number)
class RefinementFaces {
 public:
  RefinementFaces(const hull::View& hull, const hull::BaseHull& base_hull,
                  const hull::Refinement& refinement)
      : hull_(hull), base_hull_(base_hull), of_(refinement) {}

  /// Result: false where there are no more.
  bool next() {
    const uint32_t mesh_vertices = hull_.head().mesh_vertex_count;
    while (read()) {
      uint32_t youngest = number[0];
      if (number[1] > youngest) youngest = number[1];
      if (number[2] > youngest) youngest = number[2];
      if (youngest < mesh_vertices || !of_.is_split(youngest - mesh_vertices)) return true;
    }
    return false;
  }
  uint32_t number[3] = {};  // of its vertices, counter-clockwise from outside

 private:
  // The base hull's faces first (star_ == 0), then the stars of what is split back.
  bool read() {
    for (; star_ <= of_.splits().size(); ++star_, face_ = 0) {
      if (star_ == 0) {
        if (face_ == base_hull_.face_count()) continue;
        for (uint32_t k = 0; k < 3; ++k)
          number[k] = hull_.number_of(base_hull_.id_of(base_hull_.vertex_of(face_, k)));
      } else {
        const uint32_t collapse = of_.splits()[star_ - 1];
        const hull::Star star(hull_, collapse, hull_.record(collapse));
        if (face_ == star.face_count()) continue;
        uint32_t corner[3];
        star.face(face_, corner);
        for (uint32_t k = 0; k < 3; ++k) number[k] = star.number[corner[k]];
      }
      ++face_;
      return true;
    }
    return false;
  }

  const hull::View& hull_;
  const hull::BaseHull& base_hull_;
  const hull::Refinement& of_;
  uint32_t star_ = 0, face_ = 0;
};

}  // namespace firmtouch::hull_test
