// A cage under construction. It checks whether a change keeps it sound.
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

/// Limits of triangle shape. Quality is 4 sqrt(3) area / (sum of squared sides): 1 if equilateral.
struct Shape {
  double least_quality = 0.1;
  double least_cosine = -0.5;      ///< between normals of neighbours
  std::size_t most_triangles = 9;  ///< per vertex
};

double quality(const mesh::Corners& t);

/// The triangle fan around a vertex to be moved or created: one triangle per rim edge. The fan replaces some
/// triangles of the cage.
struct Star {
  std::vector<std::array<std::uint32_t, 2>> rim;
  std::vector<FaceId> replaced;
  bool on_mirror = false;

  void clear() {
    rim.clear();
    replaced.clear();
    on_mirror = false;
  }
};

/// An oriented manifold with positions. Checked changes keep at least `margin` of clearance everywhere
/// (within grid resolution), no triangle crosses another or the model, the `enclosed` points stay on their
/// side, and with a mirror no vertex lies beyond x = 0. Not thread-safe.
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
  /// Its length is twice the area.
  Vec3 normal(FaceId f) const;

  /// The star of a vertex's triangles.
  void star_of(VertexId v, Star& star) const;
  /// The star of both ends of the half-edge after its collapse.
  void star_of(HalfEdgeId h, Star& star) const;

  /// The area-weighted mean normal of the replaced triangles, a unit vector or 0; within the mirror plane if
  /// the star lies on it.
  Vec3 outward(const Star& star) const;
  /// The star of a new vertex on an edge.
  void star_of(Connectivity::EdgeHandle e, Star& star) const;
  double volume() const;
  /// Moves x, where the star must fit, to a position that encloses less, as far as it fits: inward, or
  /// towards the rim's centre. Takes a few steps per call.
  Point drawn_in(const Star& star, const Point& x, const Shape& shape);
  /// Volume of the star around x minus the volume of the triangles it replaces.
  double added_volume(const Star& star, const Point& x) const;
  /// True if the star around x is sound.
  bool fits(const Star& star, const Point& x, const Shape& shape);
  /// True if these two triangles may replace the two at an edge.
  bool fits(const std::array<mesh::Triangle, 2>& now, const std::array<FaceId, 2>& replaced,
            const Shape& shape);

  /// From now on checks this margin exactly as well; several times slower.
  void be_exact(double margin) { exact_margin_ = margin; }
  /// True if the model is nearer to the triangle than `distance`, exactly.
  bool is_near_model(FaceId f, double distance) const { return is_near_model(corners(f), distance); }

  // Apply changes that fit.
  void move(VertexId v, const Point& x);
  /// Keeps the half-edge's `to` vertex and moves it to x.
  void collapse(HalfEdgeId h, const Point& x);
  void flip(Connectivity::EdgeHandle e);
  VertexId split(Connectivity::EdgeHandle e, const Point& x);

  Shell shell() const;

private:
  // A triangle to be checked.
  struct Candidate {
    mesh::Triangle vertices;
    mesh::Corners corners;
  };
  bool is_near_model(const mesh::Corners& t, double distance) const;
  bool passes_over_a_point(std::span<const FaceId> replaced) const;
  static bool cross(const Candidate& s, const Candidate& t);
  bool crosses(std::span<const Candidate> now, std::span<const FaceId> replaced);
  // A triangle in the search grid.
  struct Placed {
    Candidate triangle{};
    mesh::Bounds box{};
    std::uint32_t seen = 0;  // number of the last query that visited it
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
  double exact_margin_ = 0;                        // 0: only checks that it does not cut the model
  std::vector<Placed> placed_;                     // one per face
  std::vector<std::vector<std::uint32_t>> cells_;  // the faces in each cell of the grid's box
  std::uint32_t question_ = 0;
  std::vector<Candidate> now_;
};

}  // namespace viete::cages
