// Cage-based mesh deformation that blends rotations and stretches in log space. This header is the whole C++
// interface.
//
// A Deformer binds a model to a cage once. Then each pose of the cage gives the positions of the model's
// vertices. The chapter "Blending" of the manual explains the choices. Points are x, y, z; angles are in
// radians. Functions throw std::runtime_error; the message says what is wrong and what to do. Results have
// the same bits for any number of threads. A moved-from object may only be destroyed or assigned to.
//
// Before 1.0 a new minor version may change this interface. There is no stable ABI.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace viete {

using Point3 = std::array<double, 3>;

/// A pointer to the members of a class. The class can be moved, but not copied.
template <class Impl>
using Hidden = std::unique_ptr<Impl, void (*)(Impl*)>;

/// Called several times a second during long work, in the calling thread, with the finished fraction from 0
/// to 1. If it throws an exception, the work is cancelled and the caller gets the exception.
using Watch = std::function<void(double done)>;

/// The content of a file besides vertices and faces: materials, texture coordinates, groups, comments.
struct FileContent;

/// A polygon mesh. Seen from outside, the corners of a face are counter-clockwise.
struct Mesh {
  std::vector<Point3> vertices;
  std::vector<std::uint32_t> corners;  ///< vertex indices of all faces, one face after the other
  /// Face f has the corners [starts[f], starts[f + 1]), so the size is face_count() + 1.
  std::vector<std::uint32_t> starts;
  /// read_mesh() sets this content. If the faces have not changed, write_mesh() writes it again.
  std::shared_ptr<const FileContent> file{};

  std::size_t face_count() const { return starts.empty() ? 0 : starts.size() - 1; }
};

/// Reads or writes OBJ, PLY, OFF, STL or glTF, chosen by the file extension. Writing is atomic. STL and glTF
/// do not keep the vertex order and polygons. If `notes` is not null, it gets warnings, one line each, for
/// example about content that the format does not support.
Mesh read_mesh(const std::filesystem::path& file, std::vector<std::string>* notes = nullptr);
void write_mesh(const std::filesystem::path& file, const Mesh& mesh,
                std::vector<std::string>* notes = nullptr);

/// Parameters of make_cage(). A value out of range is an error.
struct CageWish {
  std::string kind = "automatic";  ///< "automatic" or "box"
  std::size_t triangles = 200;     ///< approximate number, 12 to 20000; only for automatic cages
  double margin = 0.0015;          ///< distance to the model, as a fraction of its diagonal, 0.0005 to 0.2
  double gap = 0.005;             ///< closes gaps narrower than twice this fraction of the diagonal, 0 to 0.2
  std::string symmetry = "auto";  ///< normal of the mirror plane: "auto", "none", "x", "y" or "z"
  bool quads = false;             ///< joins pairs of triangles to quads if they fit well
  std::array<std::size_t, 3> cells{1, 1, 1};  ///< number of boxes along each axis; only for box cages
  bool own_axes = false;                      ///< aligns box cages with the model's principal axes
};
/// Makes a closed cage around the model, without self-intersections.
Mesh make_cage(const Mesh& model, const CageWish& wish = {}, const Watch& watch = {});

/// How the cage moves the model. `viete help deformers` describes all names and numbers; here numbers are
/// fractions. Empty members have the value of the deformer `way`.
struct Blending {
  std::string way = "smooth";      ///< deformer: "smooth", "paper", "mean-value", "rigid", "arap", "local"
  std::string weights{}, blend{};  ///< if not empty, replace the weights and the blend of the deformer
  std::optional<double> radius{};  ///< distance at which weights end, in cage sizes, 0.001 to 10
  std::optional<double> turn{}, stretch{};  ///< factors of rotations and stretches, 0 to 2
  std::optional<int> stitched{};            ///< iterations of the stitched solver, 1 to 20
  std::optional<double> pins{}, hold{};     ///< pin radius in cage sizes, and hold weight; both 0 to 1
  std::string method = "fast";              ///< method for matrices: "diag", "sd", "improved_sd" or "fast"
};

/// A model bound to a cage. Not thread-safe, but different deformers are independent. fork() waits until
/// calls in other threads have ended. The child process uses one thread.
class Deformer {
public:
  /// Checks and copies the arguments. 0 threads mean one for each processor.
  Deformer(const Mesh& model, const Mesh& cage, const Blending& blending = {}, int threads = 0);

  /// Binds for deform() in float or in double, which takes up to some seconds. Otherwise the first call of
  /// deform() binds. The memory is proportional to vertices times cage triangles.
  void bind(bool in_float, const Watch& watch = {});

  std::size_t vertex_count() const;
  /// Warnings about the cage, one line each.
  const std::vector<std::string>& notes() const;

  /// Computes the model's vertices from the cage's vertices, three numbers for each. Double gives the same
  /// bits as `viete deform`. Float uses compressed weights, as the window does, and is three to nine times as
  /// fast. The error is then up to 1e-4, usually 1e-5, of the larger diagonal of the cage at rest and posed,
  /// plus rounding. If `normals` is not empty, it gets a unit vector for each vertex (float: within 1e-4). If
  /// `turns` is not null, it must have the value of the previous pose (at first empty): a rotation vector for
  /// each part of the cage, with full turns. It gets the value of this pose. If it is null, each part uses
  /// the shortest rotation.
  void deform(std::span<const double> cage, std::span<double> positions, std::span<double> normals = {},
              std::vector<Point3>* turns = nullptr);
  void deform(std::span<const double> cage, std::span<float> positions, std::span<float> normals = {},
              std::vector<Point3>* turns = nullptr);

  /// Multiplies the motion of each vertex in later poses by a number from 0 to 1. Empty means no scaling.
  void set_mask(std::span<const float> shares);
  /// Sets the shape that the cage deforms, three numbers for each vertex. Empty means the model at rest.
  void set_shape(std::span<const double> positions);

private:
  struct Impl;
  Hidden<Impl> impl_;
};

/// Blends shapes of a mesh in log space: halfway to 180 degrees is 90 degrees. Not thread-safe.
class ShapeSpace {
public:
  /// `shapes` are vertex positions in the order of the motion. Rotations of a shape continue those of the
  /// previous shape.
  ShapeSpace(const Mesh& rest, std::span<const std::vector<Point3>> shapes, int threads = 0,
             const Watch& watch = {});

  /// The weighted sum of the shapes: (1, 0, ...) gives the first shape, and zeros give the rest shape.
  std::vector<Point3> mix(std::span<const double> weights) const;
  /// Interpolates the sequence of shapes: 0 is the first shape, 1 the second, 0.5 halfway. If `straight` is
  /// true, vertices move along straight lines.
  std::vector<Point3> between(double at, bool straight = false) const;
  /// Example-based posing: moves these vertices to `places`; all others follow blends of the shapes. An
  /// infinite `firmness` makes places exact; 0.3 pulls as strongly as neighbouring vertices do. `freedom` 0
  /// follows the shapes, 1 is as rigid as possible. If `weights` is not null, it gets the weight of each
  /// shape.
  std::vector<Point3> pose(std::span<const std::uint32_t> vertices, std::span<const Point3> places,
                           double firmness = 1e300, double freedom = 0.3,
                           std::vector<double>* weights = nullptr, const Watch& watch = {}) const;

private:
  struct Impl;
  Hidden<Impl> impl_;
};

/// Blends poses of a cage in log space, as ShapeSpace. Counts full turns of the cage's parts.
class PoseSpace {
public:
  PoseSpace(const Mesh& cage, std::span<const std::vector<Point3>> poses);

  std::vector<Point3> mix(std::span<const double> weights) const;
  std::vector<Point3> between(double at, bool straight = false) const;

private:
  struct Impl;
  Hidden<Impl> impl_;
};

/// A session saved by the window, with a model and its animation. Not thread-safe.
class Session {
public:
  explicit Session(const std::filesystem::path& file);

  Mesh model() const;  ///< the model at rest
  /// The first and the last frame. Both are 1 if the timeline has no keys.
  std::array<int, 2> range() const;
  const std::vector<std::string>& notes() const;
  /// The model's vertices at a frame, as in `viete animate`. Without keys it is the current pose.
  std::vector<Point3> frame(double frame) const;

private:
  struct Impl;
  Hidden<Impl> impl_;
};

}  // namespace viete
