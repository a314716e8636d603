#include "mesh/topology.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <mutex>

#include "mesh/defects.h"
#include "mesh/triangle.h"

namespace viete::mesh {

namespace {

using Connectivity = OpenMesh::TriConnectivity;

// Suppresses OpenMesh's terminal output; the return value reports rejected faces.
void silence_openmesh() {
  static std::once_flag once;
  std::call_once(once, [] { ::omerr().disable(); });
}

// False if OpenMesh rejects a face.
bool build(const Surface& surface, Connectivity& mesh) {
  mesh.reserve(surface.positions.size(), 3 * surface.triangles.size() / 2, surface.triangles.size());
  for (std::size_t v = 0; v < surface.positions.size(); ++v) mesh.add_vertex();
  for (const Triangle& t : surface.triangles) {
    if (repeats_corner(t)) return false;
    const OpenMesh::VertexHandle corners[3] = {Connectivity::VertexHandle(static_cast<int>(t[0])),
                                               Connectivity::VertexHandle(static_cast<int>(t[1])),
                                               Connectivity::VertexHandle(static_cast<int>(t[2]))};
    if (!mesh.add_face(corners, 3).is_valid()) return false;
  }
  return true;
}

std::vector<std::uint32_t> loop_from(const Connectivity& mesh, Connectivity::HalfedgeHandle start,
                                     std::vector<bool>& seen) {
  std::vector<std::uint32_t> loop;
  for (auto h = start; !seen[h.idx()]; h = mesh.next_halfedge_handle(h)) {
    seen[h.idx()] = true;
    loop.push_back(static_cast<std::uint32_t>(mesh.from_vertex_handle(h).idx()));
  }
  std::reverse(loop.begin(), loop.end());  // half-edges of a hole keep the hole on their left
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  return loop;
}

std::vector<std::vector<std::uint32_t>> boundary_loops(const Connectivity& mesh) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<bool> seen(mesh.n_halfedges(), false);
  for (auto h = mesh.halfedges_begin(); h != mesh.halfedges_end(); ++h) {
    if (mesh.is_boundary(*h) && !seen[h->idx()]) loops.push_back(loop_from(mesh, *h, seen));
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

}  // namespace

std::optional<Topology> topology(const Surface& surface, const Summary& summary) {
  if (!summary.manifold() || !summary.oriented() || !nonmanifold_vertices(surface).empty())
    return std::nullopt;
  silence_openmesh();
  Connectivity mesh;
  if (!build(surface, mesh)) return std::nullopt;
  Topology topology;
  topology.boundary_loops = boundary_loops(mesh);
  const auto used = static_cast<std::ptrdiff_t>(summary.vertices - summary.unused_vertices.size());
  topology.euler =
      used - static_cast<std::ptrdiff_t>(mesh.n_edges()) + static_cast<std::ptrdiff_t>(mesh.n_faces());
  const auto loops = static_cast<std::ptrdiff_t>(topology.boundary_loops.size());
  topology.genus =
      static_cast<std::size_t>((2 * static_cast<std::ptrdiff_t>(summary.parts) - loops - topology.euler) / 2);
  return topology;
}

}  // namespace viete::mesh
