#include "bench/lazy_cage.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <cmath>

#include "cages/clearance.h"
#include "cages/extraction.h"
#include "cages/soundness.h"
#include "cages/subject.h"

namespace viete::bench {

namespace {

struct LazyTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using LazyMesh = OpenMesh::TriMesh_ArrayKernelT<LazyTraits>;

mesh::Surface decimated(const cages::Shell& shell, std::size_t triangles) {
  LazyMesh lazy;
  for (const auto& p : shell.positions) lazy.add_vertex({p[0], p[1], p[2]});
  for (const auto& t : shell.triangles)
    lazy.add_face(lazy.vertex_handle(t[0]), lazy.vertex_handle(t[1]), lazy.vertex_handle(t[2]));
  OpenMesh::Decimater::DecimaterT<LazyMesh> decimater(lazy);
  OpenMesh::Decimater::ModQuadricT<LazyMesh>::Handle quadrics;
  decimater.add(quadrics);
  decimater.module(quadrics).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, triangles);
  lazy.garbage_collection();
  std::vector<mesh::Point> positions;
  for (const auto v : lazy.vertices())
    positions.push_back({lazy.point(v)[0], lazy.point(v)[1], lazy.point(v)[2]});
  std::vector<mesh::Triangle> kept;
  for (const auto f : lazy.faces()) {
    auto v = lazy.cfv_iter(f);
    mesh::Triangle t;
    for (auto& corner : t) corner = static_cast<std::uint32_t>((*v++).idx());
    kept.push_back(t);
  }
  return mesh::from_triangles(positions, kept);
}

}  // namespace

mesh::Surface lazy_cage(const mesh::Surface& model, std::size_t triangles, base::WorkerPool& pool) {
  const cages::Subject subject(model, std::nullopt, nullptr);
  const auto& [positions, pieces, box, closed] = subject.model;
  for (double offset = 0.01; offset < 1; offset *= 1.3) {
    const auto cells = static_cast<std::size_t>(4 * std::sqrt(static_cast<double>(triangles)));
    const cages::Grid grid = cages::grid_around(box, cells, offset, false);
    const auto field = cages::clearance({subject.tree, closed}, grid, {offset, 0}, pool);
    mesh::Surface cage = decimated(cages::extract(field, offset), triangles);
    const auto found = cages::soundness(cage, positions, pieces, subject.tree, pool);
    if (!found.cutting.empty() || !found.outside.empty()) continue;
    for (mesh::Point& p : cage.positions) p = subject.frame.out_of(p);
    return cage;
  }
  return {};
}

}  // namespace viete::bench
