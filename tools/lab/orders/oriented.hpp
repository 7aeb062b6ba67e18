#pragma once
// Fitting an oriented box to triangles, by the covariance of the points on them. Freestanding.
// Source: Gottschalk, Lin, Manocha 1996, "OBBTree", section 4 (the covariance of the surface, each
// triangle weighted by its area).
#include "firmtouch/mesh/view.hpp"
#include "lab/orders/kinds.hpp"

namespace firmtouch::lab::orders {

struct Covariance {
  float c[3][3];
};

static inline Covariance covariance(const mesh::View& mesh, uint32_t begin, uint32_t end,
                                    Vec3 about_m) {
  float weight = 0, sum[3] = {0, 0, 0}, product[3][3] = {};
  for (uint32_t i = begin; i < end; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    const Vec3 a = mesh.vertex(t.corner[0]) - about_m, b = mesh.vertex(t.corner[1]) - about_m,
               c = mesh.vertex(t.corner[2]) - about_m;
    const float area = math::length(cross(b - a, c - a));
    const float corner[3][3] = {{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}};
    weight += area;
    for (int r = 0; r < 3; ++r) {
      const float three_r = corner[0][r] + corner[1][r] + corner[2][r];
      sum[r] += area * three_r * (1.0f / 3.0f);
      for (int s = 0; s < 3; ++s) {
        const float three_s = corner[0][s] + corner[1][s] + corner[2][s];
        const float corners =
            corner[0][r] * corner[0][s] + corner[1][r] * corner[1][s] + corner[2][r] * corner[2][s];
        product[r][s] += area * (three_r * three_s + corners) * (1.0f / 12.0f);
      }
    }
  }
  Covariance result{};
  if (!(weight > 0.0f)) return result;
  for (int r = 0; r < 3; ++r)
    for (int s = 0; s < 3; ++s)
      result.c[r][s] = product[r][s] / weight - sum[r] * sum[s] / (weight * weight);
  return result;
}

/// Rows of `axis`: the directions that Jacobi's rotations find.
static inline void eigenvectors(Covariance m, Vec3* axis) {
  float v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 8; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const float apart = m.c[p][q];
        if (!(apart * apart > 1e-14f * (m.c[p][p] * m.c[p][p] + m.c[q][q] * m.c[q][q]))) continue;
        const float theta = (m.c[q][q] - m.c[p][p]) / (2 * apart);
        const float size = theta < 0 ? -theta : theta;
        const float t = (theta < 0 ? -1.0f : 1.0f) / (size + math::square_root(size * size + 1));
        const float c = 1 / math::square_root(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const float kp = m.c[k][p], kq = m.c[k][q];
          m.c[k][p] = c * kp - s * kq, m.c[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const float pk = m.c[p][k], qk = m.c[q][k];
          m.c[p][k] = c * pk - s * qk, m.c[q][k] = s * pk + c * qk;
          const float vp = v[p][k], vq = v[q][k];
          v[p][k] = c * vp - s * vq, v[q][k] = s * vp + c * vq;
        }
      }
  // Square to one another to the last bit that matters.
  axis[0] = {v[0][0], v[0][1], v[0][2]};
  axis[0] = axis[0] * (1 / math::length(axis[0]));
  axis[1] = {v[1][0], v[1][1], v[1][2]};
  axis[1] = axis[1] - axis[0] * dot(axis[0], axis[1]);
  axis[1] = axis[1] * (1 / math::length(axis[1]));
  axis[2] = cross(axis[0], axis[1]);
}

/// Encloses the triangles [begin, end) of the mesh; begin < end.
static inline OrientedBox fit_oriented(const mesh::View& mesh, uint32_t begin, uint32_t end) {
  OrientedBox box;
  const Vec3 about_m = mesh.vertex(mesh.triangle(begin).corner[0]);
  eigenvectors(covariance(mesh, begin, end, about_m), box.axis);
  float low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  for (uint32_t i = begin; i < end; ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3 from = mesh.vertex(mesh.triangle(i).corner[k]) - about_m;
      for (int a = 0; a < 3; ++a) {
        const float x = dot(box.axis[a], from);
        low[a] = x < low[a] ? x : low[a];
        high[a] = x > high[a] ? x : high[a];
      }
    }
  box.centre_m = about_m;
  for (int a = 0; a < 3; ++a)
    box.centre_m = box.centre_m + box.axis[a] * ((low[a] + high[a]) * 0.5f);
  const Vec3 half{(high[0] - low[0]) * 0.5f, (high[1] - low[1]) * 0.5f, (high[2] - low[2]) * 0.5f};
  const float slack_m = kOrientedSlack * (half.x + half.y + half.z);
  box.half_m = {half.x + slack_m, half.y + slack_m, half.z + slack_m};
  return box;
}

}  // namespace firmtouch::lab::orders
