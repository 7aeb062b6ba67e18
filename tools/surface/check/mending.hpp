#pragma once
#include <string>
#include <vector>

#include "surface/check/check.hpp"
#include "surface/edges.hpp"
#include "surface/surface.hpp"

// The single steps of check_and_mend(), in the order in which it takes them. Vertex numbers are the
// file's: vertices are dropped only at the end.

namespace firmtouch::tools {

/// "3 faces", "1 face".
std::string counted(uint64_t count, const char* one, const char* many);
/// "vertex 7 (0.1, 0.2, 0.3 m)".
std::string named_vertex(const Surface& surface, uint32_t vertex);
std::string named_edge(const Surface& surface, uint32_t a, uint32_t b);
std::string named_face(const Surface& surface, uint32_t face);

void drop_faces(Surface& surface, const std::vector<bool>& dropped);

void refuse_bad_numbers(const Surface& surface, CheckReport& report);
void refuse_bad_size(const Surface& surface, CheckReport& report);
void drop_pointlike_faces(Surface& surface, CheckReport& report);
void weld_torn_vertices(Surface& surface, CheckReport& report);
void drop_duplicate_faces(Surface& surface, CheckReport& report);
/// Welds vertices of open edges that lie near each other, by the least distance that closes most.
void weld_near_vertices(Surface& surface, CheckReport& report);
/// Removes fins and inner walls, at most a tenth of the area.
void drop_dangling_faces(Surface& surface, CheckReport& report);
/// Gives each sheet that meets others at an edge or a vertex vertices of its own. Pre: wound alike.
void split_sheets(Surface& surface, CheckReport& report);
/// Makes the winding of each component consistent. `component` gets each face's component, numbered
/// from 0, `turned` which faces were turned. Result: components; a surface with one side alone is
/// refused (or kept).
uint32_t wind_alike(Surface& surface, std::vector<uint32_t>& component, std::vector<bool>& turned,
                    std::vector<std::string>& defects);
/// Turns whole components so that solids lie inside; then reports all that was turned.
void wind_outward(Surface& surface, const std::vector<uint32_t>& component, uint32_t components,
                  bool is_closed, std::vector<bool>& turned, CheckReport& report);
void remove_flat_faces(Surface& surface, const CheckOptions& options, CheckReport& report);
/// Open edges, edges of more than two faces, vertices of more than one fan.
void find_topology_defects(const Surface& surface, std::vector<std::string>& defects);
/// Rejects pieces that touch so that the nearest point does not determine the sign. Pre: closed and
/// outward.
void refuse_contacts(const Surface& surface, CheckReport& report);
/// Of these, corners and edges that touch the surface elsewhere, of one piece too, without
/// rounding; and sheets of opposite orientation that are nearer than float32 resolves.
/// Pre: coordinates are finite and below 2^24 m.
void refuse_touches(const Surface& surface, CheckReport& report);
void drop_unused_vertices(Surface& surface, CheckReport& report);

}  // namespace firmtouch::tools
