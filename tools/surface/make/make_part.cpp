#include "surface/make/make_part.hpp"

#include <array>
#include <cmath>

#include "surface/make/part_shape.hpp"
#include "surface/random.hpp"
#include "surface/turns.hpp"

// The section is cut into rows, each a ring of vertices around the axis with as many as its length
// requires; every other ring is turned by half a step. Two rings are joined like a zip: whatever
// their counts, each of their edges gets one triangle of the strip, so the surface is a closed
// manifold by construction, a torus of rings.

namespace firmtouch::tools {
namespace {

struct Row {
  PartShape::Piece piece;
  double along;
  uint32_t count;   // of vertices around
  uint32_t offset;  // in half steps: 0 or 1
  uint32_t first;   // vertex
};

// How fine a piece is, in steps of the whole: the groove is what the demo touches, the foot lies on
// the table.
double spacing_of(PartShape::Piece piece) {
  switch (piece) {
    case PartShape::kGroove:
      return 0.6;
    case PartShape::kRim:
    case PartShape::kFillet:
      return 0.8;
    case PartShape::kFoot:
      return 2.0;
    default:
      return 1.0;
  }
}

double distance(SectionPoint a, SectionPoint b) {
  const double r = a.radius_m - b.radius_m, h = a.height_m - b.height_m;
  return std::sqrt(r * r + h * h);
}

double piece_length_m(const PartShape& shape, PartShape::Piece piece) {
  double length_m = 0;
  for (int k = 0; k < 16; ++k) {
    length_m += distance(shape.at(piece, k / 16.0, 0), shape.at(piece, (k + 1) / 16.0, 0));
  }
  return length_m;
}

using Lengths = std::array<double, PartShape::kPieces>;

std::vector<Row> cut(const PartShape& shape, const Lengths& lengths_m, double step_m) {
  std::vector<Row> rows;
  uint32_t vertices = 0;
  for (uint32_t p = 0; p < PartShape::kPieces; ++p) {
    const PartShape::Piece piece = static_cast<PartShape::Piece>(p);
    const double row_m = step_m * spacing_of(piece);
    const double length_m = lengths_m[p];
    const uint32_t pieces = length_m > row_m ? static_cast<uint32_t>(length_m / row_m + 0.5) : 1;
    for (uint32_t k = 0; k < pieces; ++k) {
      const double along = static_cast<double>(k) / pieces;
      const double around_m = 6.283185307179586 * shape.at(piece, along, 0).radius_m;
      const double wanted =
          around_m / (1.1547 * (k == 0 && row_m > step_m ? step_m : row_m));  // equal sides
      const uint32_t count = wanted < 12 ? 12 : static_cast<uint32_t>(wanted);
      rows.push_back({piece, along, count, static_cast<uint32_t>(rows.size() & 1), vertices});
      vertices += count;
    }
  }
  return rows;
}

uint32_t faces_of(const std::vector<Row>& rows) {
  uint32_t faces = 0;
  for (const Row& row : rows) faces += 2 * row.count;
  return faces;
}

// The fewest faces that are enough. Finer steps do not always give more: rows come and go whole.
std::vector<Row> cut_to(const PartShape& shape, uint32_t min_faces) {
  Lengths lengths_m;
  for (uint32_t p = 0; p < PartShape::kPieces; ++p) {
    lengths_m[p] = piece_length_m(shape, static_cast<PartShape::Piece>(p));
  }
  std::vector<Row> best;
  for (double step_m = 0.008; best.empty() || faces_of(best) > min_faces; step_m *= 0.998) {
    std::vector<Row> rows = cut(shape, lengths_m, step_m);
    const uint32_t faces = faces_of(rows);
    if (faces >= min_faces && (best.empty() || faces < faces_of(best))) best = std::move(rows);
    if (faces > min_faces + min_faces / 4) break;
  }
  return best;
}

double turns_of(const Row& row, uint32_t k) { return (2.0 * k + row.offset) / (2.0 * row.count); }

// The strip between two rings: always the side whose next edge has the nearer middle goes on.
void zip(const Row& a, const Row& b, std::vector<Face>& faces) {
  uint64_t i = 0, j = 0;
  while (i < a.count || j < b.count) {
    const uint32_t at_a = a.first + static_cast<uint32_t>(i % a.count);
    const uint32_t at_b = b.first + static_cast<uint32_t>(j % b.count);
    const bool nearer = (2 * i + 1 + a.offset) * b.count <= (2 * j + 1 + b.offset) * a.count;
    if (j >= b.count || (i < a.count && nearer)) {
      ++i;
      faces.push_back({at_a, at_b, a.first + static_cast<uint32_t>(i % a.count)});
    } else {
      ++j;
      faces.push_back({at_a, at_b, b.first + static_cast<uint32_t>(j % b.count)});
    }
  }
}

math::Vec3 turned(SectionPoint p, double turns) {
  return {static_cast<float>(p.radius_m * cosine_of_turns(turns)),
          static_cast<float>(p.radius_m * sine_of_turns(turns)), static_cast<float>(p.height_m)};
}

}  // namespace

Surface make_part(uint64_t seed, uint32_t min_faces) {
  const PartShape shape(seed);
  const std::vector<Row> rows = cut_to(shape, min_faces);
  Surface part;
  for (const Row& row : rows) {
    for (uint32_t k = 0; k < row.count; ++k) {
      const double turns = turns_of(row, k);
      part.vertices.push_back(turned(shape.at(row.piece, row.along, turns), turns));
    }
  }
  for (size_t r = 0; r < rows.size(); ++r) zip(rows[r], rows[(r + 1) % rows.size()], part.faces);
  for (uint32_t f = 0; f < part.faces.size(); ++f) part.source.push_back(f);
  return part;
}

std::vector<math::Vec3> make_path(uint64_t seed, uint32_t points) {
  const PartShape shape(seed);
  Random random(seed ^ 0x70617468ull);
  const double phase = random.uniform();
  std::vector<math::Vec3> path;
  for (uint32_t k = 0; k + 1 < points; ++k) {
    // Slow and fast stretches, as a recorded hand has them, and a tremble within a third of a step.
    const double even = (k + (k == 0 ? 0 : random.between(-1.0 / 6, 1.0 / 6))) / (points - 1);
    const double turns = even + 0.45 / (5 * 6.283185307179586) * sine_of_turns(5 * even + phase);
    SectionPoint p = shape.groove_floor(turns);
    p.height_m += kGuideHeight_m;
    path.push_back(turned(p, turns));
  }
  path.push_back(path.front());
  return path;
}

}  // namespace firmtouch::tools
