// A cage while it is made: what changes it asks here whether the change is sound.
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

/// What triangles must be like. A quality is 4 sqrt(3) area / (sum of squared sides): 1 if equilateral.
struct Shape {
  double least_quality = 0.1;
  double least_cosine = -0.5;      ///< between the normals of neighbours
  std::size_t most_triangles = 9;  ///< around a vertex
};

double quality(const mesh::Corners& t);

/// Triangles around a place that is to be moved or made: each runs from it along one of the rim's edges, and
/// together they replace some of the cage's.
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

/// An oriented manifold with positions, of which any change that is asked about keeps: at least `margin` of
/// clearance everywhere, as the grid resolves it, no triangle through another or through the model, these
/// points on the side where they are, and with a mirror no vertex beyond x = 0. Not thread-safe.
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
  double margin() const { return margin_; }
  std::size_t vertex_slots() const { return positions_.size(); }
  std::size_t face_count() const { return faces_; }

  mesh::Triangle vertices(FaceId f) const;
  mesh::Corners corners(FaceId f) const { return corners(vertices(f)); }
  mesh::Corners corners(const mesh::Triangle& t) const { return {at(t[0]), at(t[1]), at(t[2])}; }
  /// Not a unit vector: twice the area long.
  Vec3 normal(FaceId f) const;

  /// Of the triangles that a vertex has.
  void star_of(VertexId v, Star& star) const;
  /// Of those that it and the other end of the half-edge have together, after it is collapsed.
  void star_of(HalfEdgeId h, Star& star) const;

  /// The mean of the replaced triangles' normals by area, a unit vector, or 0; in the mirror where the star
  /// is.
  Vec3 outward(const Star& star) const;
  /// Around a new vertex on an edge.
  void star_of(Connectivity::EdgeHandle e, Star& star) const;
  double volume() const;
  /// From x, where the star fits, to where it encloses less, as far as it fits: inward, or to the middle of
  /// the rim. A few steps each time it is asked.
  Point drawn_in(const Star& star, const Point& x, const Shape& shape);
  /// What the star around x adds to the volume of what it replaces.
  double added_volume(const Star& star, const Point& x) const;
  /// True if the star around x is sound.
  bool fits(const Star& star, const Point& x, const Shape& shape);
  /// True if these two may replace those of an edge.
  bool fits(const std::array<mesh::Triangle, 2>& now, const std::array<FaceId, 2>& replaced,
            const Shape& shape);

  /// From now on, what fits keeps this margin exactly too; it takes several times as long.
  void be_exact(double margin) { exact_margin_ = margin; }
  /// The model is nearer to the triangle than that, exactly.
  bool is_near_model(FaceId f, double distance) const { return is_near_model(corners(f), distance); }

  // Changes that were found to fit.
  void move(VertexId v, const Point& x);
  /// Its `to` vertex stays, at x.
  void collapse(HalfEdgeId h, const Point& x);
  void flip(Connectivity::EdgeHandle e);
  VertexId split(Connectivity::EdgeHandle e, const Point& x);

  Shell shell() const;

private:
  // A triangle that might come to be.
  struct Candidate {
    mesh::Triangle vertices;
    mesh::Corners corners;
  };
  bool is_near_model(const mesh::Corners& t, double distance) const;
  bool passes_over_a_point(std::span<const FaceId> replaced) const;
  static bool cross(const Candidate& s, const Candidate& t);
  bool crosses(std::span<const Candidate> now, std::span<const FaceId> replaced);
  // A triangle as it was placed: where it is looked for, and what for.
  struct Placed {
    Candidate triangle{};
    mesh::Bounds box{};
    std::uint32_t seen = 0;  // the last question that it was looked at for
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
  double exact_margin_ = 0;                        // 0: it does not cut the model
  std::vector<Placed> placed_;                     // of each face
  std::vector<std::vector<std::uint32_t>> cells_;  // the faces in each part of the grid's box
  std::uint32_t question_ = 0;
  std::vector<Candidate> now_;
};

}  // namespace viete::cages
