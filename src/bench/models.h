// Models, cages and poses for the benchmarks: files, or generated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "lab/strain.h"
#include "mesh/surface.h"
#include "scene/document/document.h"

namespace viete::bench {

/// A model, and its cage if that is named, fit for frames in float. Throws base::Error.
scene::Document open_model(const std::filesystem::path& model, const std::filesystem::path& cage = {});

/// Each triangle cut into four at the middles of its edges.
mesh::Surface subdivided(const mesh::Surface& surface);

/// A closed cage of `faces` triangles (even, at least 8) around the model: the hull of directions spread
/// evenly over the sphere, each at the distance from the model's centre that leaves every vertex inside, and
/// 6 % more.
mesh::Surface star_cage(const mesh::Surface& model, std::size_t faces);

/// Twisted by 0.8 radians and bent by 0.5 along its longest axis, stretched by 1.2, every vertex moved by up
/// to 1 % of the diagonal.
deform::Pose moderate_pose(const deform::Cage& cage);

/// Of the triangles that have area at rest. J is what a triangle does to its plane, a 2x2 matrix.
struct Distortion {
  /// Symmetric Dirichlet energy |J|^2 + |J^-1|^2 less the 4 it has at rest, mean by area at rest. 0 where
  /// nothing is stretched; infinite where a triangle has collapsed.
  double energy = 0;
  /// The larger singular value of J over the smaller: 1 where all directions are stretched alike.
  double median_shear = 1, worst_shear = 1;
  std::size_t collapsed = 0;  ///< triangles that have no area any more
};

/// A model at rest, and what its shape is compared by. Positions are always one per vertex of the model.
class RestModel {
public:
  /// Throws base::Error if no triangle has area.
  explicit RestModel(const mesh::Surface& model);

  const std::vector<mesh::Point>& positions() const { return positions_; }
  /// Closed and oriented alike, around some volume.
  bool encloses() const { return volume_ != 0; }
  /// Triangles without area, which count for nothing.
  std::size_t without_area() const { return without_area_; }
  /// A third of the triangles around each vertex; they sum to 1.
  const std::vector<double>& vertex_shares() const { return shares_; }

  Distortion distortion(std::span<const mesh::Point> positions) const;
  /// Bending energy of discrete shells: the sum over edges between two triangles of 3 |e|^2 (t - t0)^2 / A,
  /// t - t0 the change of the angle between the two, |e| the edge and A their area at rest. Where the model
  /// is bent smoothly it stays about the same when triangles become smaller, and where it shows kinks it
  /// grows. (Grinspun et al. 2003, Discrete Shells.)
  double bending(std::span<const mesh::Point> positions) const;
  /// That of the model over that at rest; NaN if it encloses none.
  double volume(std::span<const mesh::Point> positions) const;

private:
  /// Two triangles at an edge: its ends, and the corners opposite.
  struct Hinge {
    std::array<std::uint32_t, 4> corners;
    double weight, angle;
  };

  void add_faces(const mesh::Surface& model);
  void add_hinges(const mesh::Surface& model);

  std::vector<mesh::Point> positions_;
  std::vector<mesh::Triangle> triangles_;  // all of them
  std::vector<lab::FlatFace> faces_;
  std::vector<Hinge> hinges_;
  std::vector<double> shares_;
  std::size_t without_area_ = 0;
  double area_ = 0, volume_ = 0;
};

}  // namespace viete::bench
