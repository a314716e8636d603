// A cage under construction. Tests whether the cage stays sound after a change.
#pragma once

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cages/clearance.h"
#include "cages/extraction.h"
#include "mesh/triangle.h"

namespace viete::cages {

using Connectivity = OpenMesh::TriConnectivity;
using VertexId = Connectivity::VertexHandle;
using FaceId = Connectivity::FaceHandle;
using HalfEdgeId = Connectivity::HalfedgeHandle;

/// Limits for the shape of triangles.
struct Shape {
  double least_quality = 0.1;
  double least_cosine = -0.5;      ///< the smallest allowed cosine between the normals of neighbours
  std::size_t most_triangles = 9;  ///< the largest allowed number of triangles at a vertex
};

/// Returns 4 * sqrt(3) * area / (sum of the squared sides). The quality of an equilateral triangle is 1.
double quality(const mesh::Corners& t);

/// The triangles around a moved or new vertex, and the triangles that they replace.
struct Star {
  std::vector<std::array<std::uint32_t, 2>> rim;  ///< the edges opposite the vertex, one per new triangle
  std::vector<FaceId> replaced;                   ///< the old triangles
  bool on_mirror = false;                         ///< true if the moved or new vertex is on the mirror plane

  void clear() {
    rim.clear();
    replaced.clear();
    on_mirror = false;
  }
};

/// A cage under construction: an oriented manifold. Not thread-safe. A change fits if:
/// - the new triangles keep the limits of Shape, and intersect neither other triangles nor the model,
/// - their clearance is at least `margin`, to the resolution of the grid,
/// - each `enclosed` point stays on its side of the cage, and a mirrored cage stays in x >= 0.
class WorkingCage {
public:
  WorkingCage(const Shell& shell, const mesh::TriangleTree& model, const Clearance& clearance, double margin,
              std::span<const Point> enclosed = {});

  Connectivity& connectivity() { return connectivity_; }
  const Connectivity& connectivity() const { return connectivity_; }
  const Point& at(VertexId v) const { return positions_[static_cast<std::size_t>(v.idx())]; }
  const Point& at(std::uint32_t v) const { return positions_[v]; }
  bool mirrored() const { return clearance_.grid().mirrored; }
  double step() const { return clearance_.grid().step; }
  std::size_t vertex_slots() const { return positions_.size(); }
  std::size_t face_count() const { return faces_; }

  mesh::Triangle vertices(FaceId f) const;
  mesh::Corners corners(FaceId f) const { return corners(vertices(f)); }
  mesh::Corners corners(const mesh::Triangle& t) const { return {at(t[0]), at(t[1]), at(t[2])}; }
  /// Returns the normal of a triangle. The length of the normal is twice the triangle's area.
  Vec3 normal(FaceId f) const;

  /// Writes the star of the vertex v to `star`.
  void star_of(VertexId v, Star& star) const;
  /// Writes the star of the vertex that remains after the half-edge collapses.
  void star_of(HalfEdgeId h, Star& star) const;
  /// Writes the star of a new vertex on the edge.
  void star_of(Connectivity::EdgeHandle e, Star& star) const;

  /// Returns the mean normal of the replaced triangles, weighted by area. The result has length 1, or 0 if
  /// the normals cancel. If the star is on the mirror plane, the result is parallel to this plane.
  Vec3 outward(const Star& star) const;
  double volume() const;
  /// Returns a position of the star's vertex where the star fits and the cage has less volume than with the
  /// vertex at x. If none is found, returns x.
  Point drawn_in(const Star& star, const Point& x, const Shape& shape);
  /// Returns the volume that the cage gains if the star, with its vertex at x, replaces the old triangles.
  double added_volume(const Star& star, const Point& x) const;
  /// True if the star fits with its vertex at x.
  bool fits(const Star& star, const Point& x, const Shape& shape);
  /// True if the triangles `now` fit as replacements of `replaced`, two triangles with a common edge.
  bool fits(const std::array<mesh::Triangle, 2>& now, const std::array<FaceId, 2>& replaced,
            const Shape& shape);

  /// After this call, fits() also tests this margin exactly, and takes several times as long.
  void be_exact(double margin) { exact_margin_ = margin; }
  /// True if the exact distance from the triangle to the model is less than `distance`.
  bool is_near_model(FaceId f, double distance) const { return is_near_model(corners(f), distance); }

  // The functions below change the cage. The change must fit.

  void move(VertexId v, const Point& x);
  /// Collapses the half-edge. Keeps its `to` vertex, and moves this vertex to x.
  void collapse(HalfEdgeId h, const Point& x);
  void flip(Connectivity::EdgeHandle e);
  VertexId split(Connectivity::EdgeHandle e, const Point& x);

  Shell shell() const;

private:
  struct Candidate {
    mesh::Triangle vertices;
    mesh::Corners corners;
  };
  bool is_near_model(const mesh::Corners& t, double distance) const;
  bool passes_over_a_point(std::span<const FaceId> replaced) const;
  static bool cross(const Candidate& s, const Candidate& t);
  bool crosses(std::span<const Candidate> now, std::span<const FaceId> replaced);
  struct Placed {
    Candidate triangle{};
    mesh::Bounds box{};
    std::uint32_t seen = 0;  // the number of the last query that found this triangle
    bool is_placed = false;
  };
  void place(FaceId f);
  void take_away(FaceId f);
  template <class Visit>
  void for_cells(const mesh::Bounds& box, Visit&& visit) const;

  Connectivity connectivity_;
  std::vector<Point> positions_;
  const mesh::TriangleTree& model_;
  const Clearance& clearance_;
  double margin_;
  std::span<const Point> enclosed_;
  std::size_t faces_;
  double exact_margin_ = 0;  // if 0, only tests that triangles do not intersect the model
  std::vector<Placed> placed_;
  std::vector<std::vector<std::uint32_t>> cells_;  // the triangles in each cell of the search grid
  std::uint32_t question_ = 0;
  std::vector<Candidate> now_;
};

}  // namespace viete::cages
