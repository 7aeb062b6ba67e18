#include "bake/mesh/bake_signs.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "bake/mesh/sign_proof.hpp"
#include "surface/check/mending.hpp"

namespace firmtouch::tools {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

Edge edge_of(const Surface& surface, uint32_t h) {
  const Face& face = surface.faces[h / 3];
  return std::minmax(face[h % 3], face[(h % 3 + 1) % 3]);
}

// The place of each feature where the surface crosses itself.
struct Places {
  std::map<uint32_t, size_t> faces, vertices;
  std::map<Edge, size_t> edges;

  explicit Places(const Crossings& crossings) {
    for (size_t p = 0; p < crossings.places.size(); ++p) {
      for (const uint32_t f : crossings.places[p].faces) faces[f] = p;
      for (const uint32_t v : crossings.places[p].vertices) vertices[v] = p;
      for (const Edge& e : crossings.places[p].edges) edges[e] = p;
    }
  }
  /// There no normal is right.
  Excused excused(const Surface& surface) const {
    Excused all;
    if (faces.empty()) return all;
    all.faces.resize(surface.faces.size());
    all.edges.resize(3 * surface.faces.size());
    all.vertices.resize(surface.vertices.size());
    for (const auto& [f, place] : faces) all.faces[f] = true;
    for (const auto& [v, place] : vertices) all.vertices[v] = true;
    for (uint32_t h = 0; h < all.edges.size(); ++h)
      all.edges[h] = edges.count(edge_of(surface, h)) != 0;
    return all;
  }
};

std::string at(const math::Vec3& v) {
  return "(" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) +
         " m)";
}

std::string more(size_t count) {
  return count > 1 ? " (the first of " + std::to_string(count) + ")" : std::string();
}

std::string problem_of(const Surface& surface, const SignProof& proof) {
  const char* remedy = "; blunt it, or bake with --unsigned";
  const auto at_face = [&](uint32_t f) { return at(surface.vertices[surface.faces[f][0]]); };
  const auto &faces = proof.faces.weak, &edges = proof.edges.weak, &vertices = proof.vertices.weak;
  if (!faces.empty())
    return "the triangle at " + at_face(faces[0]) + more(faces.size()) +
           " is so thin that float32 loses its normal: inside and outside cannot be decided there; "
           "join its corners, or bake with --unsigned";
  if (!vertices.empty())
    return "the corner at " + at(surface.vertices[vertices[0]]) + more(vertices.size()) +
           " is too sharp a needle for the nearest point to decide inside and outside" + remedy;
  if (!edges.empty())
    return "the triangle at " + at_face(edges[0] / 3) + more(edges.size()) +
           " folds back on its neighbour: inside and outside cannot be decided there" + remedy;
  return {};
}

void compare(const Surface& surface, const ExactNormals& exact, const Pseudonormals& stored,
             const Places& places, SignReport& report) {
  report.differing.resize(report.crossings.places.size() + 1);
  const DifferingSides sides = compare_with_winding(surface, exact, stored);
  report.compared = sides.compared;
  const auto slot = [&](const auto& known, const auto& feature) -> SignReport::Differing& {
    const auto found = known.find(feature);
    return found == known.end() ? report.differing.back() : report.differing[found->second];
  };
  for (const uint32_t f : sides.faces) slot(places.faces, f).faces.push_back(f);
  for (const uint32_t v : sides.vertices) slot(places.vertices, v).vertices.push_back(v);
  for (const uint32_t h : sides.edges) {
    const Edge edge = edge_of(surface, h);
    slot(places.edges, edge).edges.push_back(edge);
  }
}

// Result: whether any sliver was turned.
bool turn(const std::vector<uint32_t>& slivers, const std::vector<uint32_t>& mates,
          double max_move_m, Surface& surface, SignReport& report) {
  const TurnedSlivers turned = turn_slivers(
      surface, mates, slivers, max_move_m - report.turned.moved_m, confusion_m(surface));
  if (turned.flips == 0) return false;
  longest_edge_first(surface);
  report.turned.flips += turned.flips;
  report.turned.moved_m += turned.moved_m;
  return true;
}

// The check was before the flips.
std::string contacts_of(const Surface& surface) {
  CheckReport report;
  refuse_contacts(surface, report);
  return report.usable() ? std::string() : report.refused[0];
}

std::string first_few(size_t count, const std::function<uint32_t(size_t)>& index) {
  constexpr size_t kShown = 5;
  std::string text;
  for (size_t i = 0; i < count && i < kShown; ++i)
    text += (i == 0 ? " (" : ", ") + std::to_string(index(i));
  return text + (count > kShown ? ", ...)" : count > 0 ? ")" : "");
}

}  // namespace

Pseudonormals bake_signs(Surface& surface, double max_move_m, SignReport& report,
                         std::string& problem) {
  constexpr int kMaxRounds = 16;  // a flip may leave another sliver
  size_t crossings_before = 0;
  for (int round = 0;; ++round) {
    const ExactNormals exact(surface);
    const Pseudonormals stored = make_pseudonormals(surface, exact);
    report.crossings = find_crossings(surface);
    if (round == 0) crossings_before = report.crossings.pairs.size();
    const Places places(report.crossings);
    const SignProof proof =
        prove_signs(surface, exact, stored, kMinMargin_rad, places.excused(surface));
    if (round < kMaxRounds && turn(proof.slivers, exact.mates, max_move_m, surface, report))
      continue;
    report.face_margin_rad = proof.faces.smallest_rad;
    report.edge_margin_rad = proof.edges.smallest_rad;
    report.vertex_margin_rad = proof.vertices.smallest_rad;
    problem = problem_of(surface, proof);
    if (problem.empty() && report.turned.flips != 0) problem = contacts_of(surface);
    if (problem.empty() && report.crossings.pairs.size() > crossings_before)
      problem = "crosses itself where thin triangles are turned; remove slivers from the model";
    if (!report.crossings.pairs.empty()) compare(surface, exact, stored, places, report);
    return stored;
  }
}

std::vector<std::string> describe(const SignReport& report, const Surface& surface,
                                  const std::vector<uint32_t>& vertex_source) {
  std::vector<std::string> lines;
  if (report.turned.flips != 0)
    lines.push_back("mended: turned the longest edge of " +
                    counted(report.turned.flips, "triangle", "triangles") +
                    " so thin that float32 confuses its edges; no vertex moved, the surface by " +
                    surface.frame.length_text(report.turned.moved_m) + " at most");
  for (const std::string& line : describe(report.crossings, surface, vertex_source))
    lines.push_back(line);
  const auto file_face = [&](uint32_t f) {
    return f < surface.source.size() ? surface.source[f] : f;
  };
  const auto file_vertex = [&](uint32_t v) {
    return v < vertex_source.size() ? vertex_source[v] : v;
  };
  for (size_t p = 0; p < report.differing.size(); ++p) {
    const SignReport::Differing& at = report.differing[p];
    const bool is_rest = p + 1 == report.differing.size();
    if (is_rest && at.count() == 0) continue;
    lines.push_back(
        (is_rest ? std::string("away from those places") : "at place " + std::to_string(p + 1)) +
        " the stored side differs from the winding number at " +
        counted(at.vertices.size(), "vertex", "vertices") +
        first_few(at.vertices.size(), [&](size_t i) { return file_vertex(at.vertices[i]); }) +
        ", " + counted(at.edges.size(), "edge", "edges") + ", " +
        counted(at.faces.size(), "face", "faces") +
        first_few(at.faces.size(), [&](size_t i) { return file_face(at.faces[i]); }) + " of " +
        std::to_string(report.compared) + " features compared");
  }
  return lines;
}

}  // namespace firmtouch::tools
