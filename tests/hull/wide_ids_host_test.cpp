// Two bytes an id: 65,536 ids and as many triangles, and not one more.
#include <vector>

#include "firmtouch/hull/view.hpp"
#include "harness/rules.hpp"

namespace firmtouch {
namespace {

// A hull without collapses; rejected before any vertex is read.
uint32_t refusal_of(uint32_t vertex_count, uint32_t triangle_count, uint32_t id_bytes) {
  mesh::Head mesh{};
  mesh.vertex_count = vertex_count;
  mesh.triangle_count = triangle_count;
  hull::Head head{};
  head.mesh_vertex_count = vertex_count;
  head.mesh_triangle_count = triangle_count;
  head.id_bytes = id_bytes;
  head.coordinate_bytes = 2;
  const std::vector<mesh::Vertex> vertices(vertex_count);
  const std::vector<mesh::Triangle<uint32_t>> triangles(triangle_count);
  hull::Sections sections;
  sections.mesh_head = test::bytes(&mesh, sizeof mesh);
  sections.mesh_vertices = test::bytes(vertices.data(), 12 * vertex_count);
  sections.triangles32 = test::bytes(triangles.data(), 12 * triangle_count);
  sections.head = test::bytes(&head, sizeof head);
  return test::refusal(test::verdict_of<hull::View>(sections));
}

constexpr uint32_t kNoOrigins = hull::kRuleOriginsSize * 1000u;  // what is checked next

}  // namespace

TEST(R502_MoreIdsOrTrianglesThanTwoBytesExpress) {
  CHECK_EQ(refusal_of(65536, 65536, 2), kNoOrigins);
  CHECK_EQ(refusal_of(65537, 65536, 2), 502'003u);
  CHECK_EQ(refusal_of(65536, 65537, 2), 502'003u);
  CHECK_EQ(refusal_of(65537, 65537, 3), kNoOrigins);
}

}  // namespace firmtouch
