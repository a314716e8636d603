#include "dragon/relax.h"

namespace viete::dragon {
namespace {

constexpr double kDifference = 5e-4;  // step of the field's gradient

Vec3 projected(Vec3 p, const Field& field, double reach, int steps) {
  const std::vector<int> parts = field.near(p, 2 * reach);
  const Vec3 start = p;
  for (int step = 0; step < steps; ++step) {
    const Vec3 slope = field.gradient(p, parts, kDifference);
    const double square = dot(slope, slope);
    if (square < 0.01) break;  // no direction to speak of: a ridge inside the body
    p = p - slope * (field.value(p, parts) / square);
  }
  return length(p - start) <= reach ? p : start;
}

}  // namespace

void project(Mesh& mesh, const Field& field, double reach, int steps) {
  for (Vec3& p : mesh.positions) p = projected(p, field, reach, steps);
}

void even_out(Mesh& mesh, double part) {
  const std::size_t count = mesh.positions.size();
  std::vector<Vec3> sums(count), normals(count);
  std::vector<double> weights(count);
  for (const auto& corner : mesh.triangles) {
    const Vec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
    const Vec3 normal = cross(b - a, c - a);
    const double area = length(normal);
    for (std::uint32_t v : corner) {
      sums[v] = sums[v] + (a + b + c) * (area / 3);
      weights[v] += area;
      normals[v] = normals[v] + normal;
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (weights[v] == 0 || dot(normals[v], normals[v]) == 0) continue;
    const Vec3 normal = normalized(normals[v]);
    const Vec3 move = sums[v] * (1 / weights[v]) - mesh.positions[v];
    mesh.positions[v] = mesh.positions[v] + (move - normal * dot(move, normal)) * part;
  }
}

}  // namespace viete::dragon
