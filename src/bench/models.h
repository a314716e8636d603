// Models, cages and poses for the benchmarks, from files or generated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analysis/strain.h"
#include "deform/cage.h"
#include "document/document.h"
#include "mesh/surface.h"

namespace viete::bench {

/// Inputs and sizes of a benchmark of a model.
struct ModelOptions {
  std::filesystem::path model;
  std::filesystem::path cage;                ///< empty: cages of `faces` triangles are generated
  std::vector<std::filesystem::path> poses;  ///< posed cages
  std::size_t count = 0;                     ///< vertices: the model is truncated or subdivided; 0: unchanged
  std::vector<std::size_t> faces = {50, 100, 300, 600};
  std::size_t rounds = 11;
  std::filesystem::path json;  ///< output of the numbers; empty: none
  bool force = false;          ///< replaces any file
};

/// A model, and its cage if given, prepared for frames in float. Throws base::Error.
document::Document open_model(const std::filesystem::path& model, const std::filesystem::path& cage = {});

/// The model of these options, and its cages.
struct BenchModel {
  explicit BenchModel(const ModelOptions& options);

  mesh::Surface model;
  std::vector<std::shared_ptr<const deform::Cage>> cages;
};

/// "pose_alert" without "pose_" is "alert".
std::string without_prefix(const std::string& name, const std::string& prefix);

/// Divides each triangle into four at the midpoints of its edges.
mesh::Surface subdivided(const mesh::Surface& surface);

/// A closed cage of `faces` triangles (even, at least 8) around the model: the hull of directions spread
/// evenly over the sphere, each at the distance from the model's centre that encloses every vertex, plus 6 %.
mesh::Surface star_cage(const mesh::Surface& model, std::size_t faces);

/// Twisted by 0.8 radians and bent by 0.5 along its longest axis, stretched by 1.2, every vertex moved by up
/// to 1 % of the diagonal.
deform::Pose moderate_pose(const deform::Cage& cage);

/// Distortion of triangles with area at rest. J, a 2x2 matrix, is the map of a triangle's plane.
struct Distortion {
  /// Symmetric Dirichlet energy |J|^2 + |J^-1|^2 minus 4, its value at rest; mean by area at rest. 0 without
  /// stretching; infinite if a triangle has collapsed.
  double energy = 0;
  std::size_t collapsed = 0;  ///< triangles whose area became 0
};

/// A model at rest, with the measures of its shapes. Positions are always one per vertex of the model.
class RestModel {
public:
  /// Throws base::Error if no triangle has area.
  explicit RestModel(const mesh::Surface& model);

  const std::vector<mesh::Point>& positions() const { return positions_; }
  /// True if closed and consistently oriented, with nonzero volume.
  bool encloses() const { return volume_ != 0; }
  /// Number of triangles without area, which are ignored.
  std::size_t without_area() const { return without_area_; }
  /// Share of the area per vertex, a third of its triangles; sum 1.
  const std::vector<double>& vertex_shares() const { return shares_; }

  Distortion distortion(std::span<const mesh::Point> positions) const;
  /// Bending energy of discrete shells: the sum over edges between two triangles of 3 |e|^2 (t - t0)^2 / A, t
  /// - t0 the change of the dihedral angle, |e| the edge and A the area of both at rest. For smooth bending
  /// it is nearly independent of the resolution; for kinks it grows with it. (Grinspun et al. 2003, Discrete
  /// Shells.)
  double bending(std::span<const mesh::Point> positions) const;
  /// Volume relative to that at rest; NaN if the model encloses none.
  double volume(std::span<const mesh::Point> positions) const;

private:
  /// Two triangles at an edge: its ends, and the opposite corners.
  struct Hinge {
    std::array<std::uint32_t, 4> corners;
    double weight, angle;
  };

  void add_faces(const mesh::Surface& model);
  void add_hinges(const mesh::Surface& model);

  std::vector<mesh::Point> positions_;
  std::vector<mesh::Triangle> triangles_;  // all triangles
  std::vector<analysis::FlatFace> faces_;
  std::vector<Hinge> hinges_;
  std::vector<double> shares_;
  std::size_t without_area_ = 0;
  double area_ = 0, volume_ = 0;
};

}  // namespace viete::bench
