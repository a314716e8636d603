// Models, cages and poses for the benchmarks, read from files or generated.
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
#include "document/document.h"
#include "mesh/surface.h"
#include "pose/cage.h"

namespace viete::bench {

/// Inputs and sizes of a benchmark that uses a model.
struct ModelOptions {
  std::filesystem::path model;
  std::filesystem::path cage;                ///< if empty, cages of `faces` triangles are generated
  std::vector<std::filesystem::path> poses;  ///< posed cages
  std::size_t count = 0;                     ///< approximate number of vertices to use; 0 keeps the model
  std::vector<std::size_t> faces = {50, 100, 300, 600};
  std::size_t rounds = 11;
  std::filesystem::path json;  ///< file for the numbers; if empty, no file is written
  bool force = false;          ///< true if existing files may be replaced
};

/// Opens a model and, if given, its cage, for frames in float. Throws base::Error.
document::Document open_model(const std::filesystem::path& model, const std::filesystem::path& cage = {});

struct BenchModel {
  explicit BenchModel(const ModelOptions& options);

  mesh::Surface model;
  std::vector<std::shared_ptr<const pose::Cage>> cages;
};

/// Removes a prefix: "pose_alert" becomes "alert".
std::string without_prefix(const std::string& name, const std::string& prefix);

/// Divides each triangle into four at the midpoints of its edges.
mesh::Surface subdivided(const mesh::Surface& surface);

/// Returns a closed cage of `faces` triangles (even, at least 8). The corners of the cage lie in directions
/// spread evenly over the sphere, each at the smallest distance that encloses the model, plus 6 %.
mesh::Surface star_cage(const mesh::Surface& model, std::size_t faces);

/// Returns a pose of the cage: twisted by 0.8 radians and bent by 0.5 radians along its longest axis, and
/// stretched by 1.2. Every vertex also moves by up to 1 % of the diagonal.
pose::Pose moderate_pose(const pose::Cage& cage);

/// Distortion of the triangles that have an area at rest. The 2x2 matrix J maps the plane of a triangle at
/// rest to its deformed plane.
struct Distortion {
  /// The symmetric Dirichlet energy minus its value at rest: the mean of |J|^2 + |J^-1|^2 - 4, weighted by
  /// the area at rest. It is 0 without stretching, and infinite if a triangle has collapsed.
  double energy = 0;
  std::size_t collapsed = 0;  ///< number of triangles whose area became 0
};

/// Compares shapes of a model with the model at rest. Positions always have one entry per vertex.
class RestModel {
public:
  /// Throws base::Error if no triangle has an area.
  explicit RestModel(const mesh::Surface& model);

  const std::vector<mesh::Point>& positions() const { return positions_; }
  /// Returns true if the model is closed and consistently oriented, and has a nonzero volume.
  bool encloses() const { return volume_ != 0; }
  /// Returns the number of triangles without area. All functions ignore these triangles.
  std::size_t without_area() const { return without_area_; }
  /// Returns for each vertex: a third of the area of its triangles, divided by the area of the model.
  const std::vector<double>& vertex_shares() const { return shares_; }

  Distortion distortion(std::span<const mesh::Point> positions) const;
  /// Returns the bending energy of discrete shells (Grinspun et al. 2003, Discrete Shells): the sum of
  /// 3 |e|^2 (t - t0)^2 / A over edges between two triangles. t - t0 is the change of the dihedral angle. |e|
  /// is the length of the edge and A the area of the two triangles, both at rest. For smooth bending, the
  /// energy hardly depends on the resolution; for kinks, the energy grows with the resolution.
  double bending(std::span<const mesh::Point> positions) const;
  /// Returns the volume relative to rest, or NaN if the model encloses no volume.
  double volume(std::span<const mesh::Point> positions) const;

private:
  /// Two triangles with a common edge.
  struct Hinge {
    std::array<std::uint32_t, 4> corners;  ///< the ends of the edge, then the opposite corners
    double weight, angle;
  };

  void add_faces(const mesh::Surface& model);
  void add_hinges(const mesh::Surface& model);

  std::vector<mesh::Point> positions_;
  std::vector<mesh::Triangle> triangles_;
  std::vector<analysis::FlatFace> faces_;
  std::vector<Hinge> hinges_;
  std::vector<double> shares_;
  std::size_t without_area_ = 0;
  double area_ = 0, volume_ = 0;
};

}  // namespace viete::bench
