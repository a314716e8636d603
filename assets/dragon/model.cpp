#include "dragon/model.h"

#include <stdexcept>
#include <string>

#include "dragon/anatomy.h"
#include "dragon/files.h"
#include "dragon/loop.h"
#include "dragon/polygonise.h"
#include "dragon/poses.h"
#include "dragon/relax.h"
#include "dragon/shapes.h"
#include "dragon/simplify.h"

namespace viete::dragon {
namespace {

constexpr double kSpacing = 0.006;  // of the lattice: a finger bone's tip is three cells thick

/// The face is small and looked at most.
double importance(Vec3 p) {
  return 1 + 5 * smooth_step(0.35, 0.20, length(p - Vec3{0.82, 1.38, 0.07}));
}

void require_sphere(const Mesh& mesh) {
  const std::size_t triangles = mesh.triangles.size();
  if (mesh.positions.size() == kVertices && triangles == 2 * kVertices - 4) return;
  throw std::runtime_error("the dragon has " + std::to_string(mesh.positions.size()) + " vertices and " +
                           std::to_string(triangles) +
                           " triangles, and so is no single part of genus 0: look for "
                           "spines, horns or claws that touch, and for tips finer than the lattice");
}

}  // namespace

Mesh dragon_mesh() {
  const Field field = dragon_field();
  Mesh mesh = polygonise(field, kSpacing);
  for (int i = 0; i < 2; ++i) even_out(mesh, 0.7);
  mesh = simplify(std::move(mesh), kVertices, 0.5 * kSpacing, importance);
  for (int i = 0; i < 2; ++i) {
    even_out(mesh, 0.4);
    project(mesh, field, kSpacing, 2);
  }
  stand_on_ground(mesh.positions);
  require_sphere(mesh);
  return mesh;
}

void write_files(const std::filesystem::path& folder) {
  const Mesh dragon = dragon_mesh();
  write_ply(folder / "dragon.ply", dragon, "Viete dragon, made by generate_dragon; MIT licence");
  for (const Shape& shape : dragon_shapes(dragon)) write_pc2(folder / (shape.name + ".pc2"), shape.positions);
  const Cage cage = dragon_cage();
  write_obj(folder / "cage.obj", cage.mesh,
            "Viete dragon, the cage at rest, made by generate_dragon; MIT licence");
  for (const Pose& pose : dragon_poses(cage))
    write_obj(folder / (pose.name + ".obj"), pose.mesh, pose.comment);
  write_whole(folder / "loop.viete", loop_session(cage));
}

}  // namespace viete::dragon
