// Cage-based mesh deformation with rotations and stretches blended in log space. This header is the whole C++
// interface; it needs neither OpenGL nor Eigen.
//
// A Deformer binds a model to a cage once; each pose of the cage then gives the positions of the model's
// vertices. The manual's chapter on blending explains the choices. Lengths are in the unit of the vertices,
// angles in radians, points are x, y, z. Functions throw std::runtime_error; its message says what is wrong
// and what to do. Results are bit-identical for any number of threads. A moved-from object may only be
// destroyed or assigned to.
//
// Before 1.0 a new minor version may change this interface. It has no stable ABI.
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

/// Progress callback of long work: called several times a second, in the calling thread, with the finished
/// fraction, 0 to 1. An exception that it throws cancels the work and is passed on to the caller.
using Watch = std::function<void(double done)>;

/// A polygon mesh. Corners of a face run counter-clockwise as seen from outside.
struct Mesh {
  std::vector<Point3> vertices;
  std::vector<std::uint32_t> corners;  ///< vertex indices from 0, one face after the other
  std::vector<std::uint32_t>
      starts;  ///< face f has corners [starts[f], starts[f + 1]); starts has face_count() + 1 entries

  std::size_t face_count() const { return starts.empty() ? 0 : starts.size() - 1; }
};

/// Reads or writes OBJ, PLY, OFF, STL or glTF, chosen by the file extension. Writing is atomic. STL and glTF
/// keep neither the vertex order nor polygons. notes, if not null, receives warnings, one line each.
Mesh read_mesh(const std::filesystem::path& file, std::vector<std::string>* notes = nullptr);
void write_mesh(const std::filesystem::path& file, const Mesh& mesh);

/// Parameters of make_cage(). Values out of range are errors.
struct CageWish {
  std::string kind = "automatic";  ///< "automatic" or "box"
  std::size_t triangles = 200;     ///< approximate number, 12 to 20000; automatic cages only
  double margin = 0.0015;          ///< distance to the model, as a fraction of its diagonal, 0.0005 to 0.2
  double gap = 0.005;             ///< closes gaps narrower than twice this fraction of the diagonal, 0 to 0.2
  std::string symmetry = "auto";  ///< mirror plane, by its normal: "auto", "none", "x", "y" or "z"
  bool quads = false;             ///< pairs triangles into quads where they fit well
  std::array<std::size_t, 3> cells{1, 1, 1};  ///< boxes along each axis; box cages only
  bool own_axes = false;                      ///< aligns box cages with the model's principal axes
};
/// A closed cage around the model, without self-intersections.
Mesh make_cage(const Mesh& model, const CageWish& wish = {}, const Watch& watch = {});

/// How the cage moves the model, with the names used by `viete deform`. Empty members take the value of the
/// deformer `way`.
struct Blending {
  std::string way = "smooth";               ///< "smooth", "paper", "mean-value", "rigid", "arap", "local"
  std::string weights{}, blend{};           ///< override those of `way`; empty: not overridden
  std::optional<double> radius{};           ///< reach of weights, in cage sizes, 0.001 to 10
  std::optional<double> turn{}, stretch{};  ///< factors on rotations and stretches, 0 to 2
  std::optional<int> stitched{};            ///< iterations of the stitched solver, 1 to 20
  std::optional<double> pins{}, hold{};     ///< pin radius in cage sizes, hold weight; both 0 to 1
  std::string method = "fast";              ///< matrix functions: "diag", "sd", "improved_sd" or "fast"
};

/// A frame that moves, rotates and stretches the points near it: y = place + exp(turn) exp(stretch) (x -
/// place) + move.
struct Probe {
  Point3 place{};                   ///< rest position
  double radius = 1;                ///< reach, above 0 and up to 1e60
  std::string falloff = "smooth";   ///< "smooth", "round", "linear", "sharp", "even", "endless"
  Point3 turn{};                    ///< rotation vector, in radians
  std::array<double, 6> stretch{};  ///< logarithm of the stretch, upper triangle by rows: xx xy xz yy yz zz
  Point3 move{};                    ///< translation
};

/// A model bound to a cage. Not thread-safe; several deformers are independent. fork() waits until deform()
/// calls of other threads end; the child process works with one thread.
class Deformer {
public:
  /// Checks and copies its arguments. threads: the maximum number; 0 for one per processor.
  Deformer(const Mesh& model, const Mesh& cage, const Blending& blending = {}, int threads = 0);
  ~Deformer();
  Deformer(Deformer&&) noexcept;
  Deformer& operator=(Deformer&&) noexcept;

  /// Binds for poses in float or in double; otherwise the first deform() of each kind binds. Takes up to some
  /// seconds; memory is proportional to vertices times cage triangles.
  void bind(bool in_float, const Watch& watch = {});

  std::size_t vertex_count() const;
  std::size_t cage_vertex_count() const;
  /// Warnings about the cage and the binding, one line each.
  const std::vector<std::string>& notes() const;

  /// Maps positions of the cage's vertices to positions of the model's, three numbers each. Double gives the
  /// bits of `viete deform`. Float uses compressed weights, as the window does: three to nine times as fast,
  /// with an error of up to 1e-4, usually 1e-5, of the cage's diagonal (the larger of rest and pose), plus
  /// rounding to float. normals: empty, or receives one unit vector per vertex. turns, if not null: the full
  /// rotations of the cage's parts in the previous pose, one rotation vector each; receives those of this
  /// pose. Without it each part takes the shortest rotation.
  void deform(std::span<const double> cage, std::span<double> positions, std::span<double> normals = {},
              std::vector<Point3>* turns = nullptr);
  void deform(std::span<const double> cage, std::span<float> positions, std::span<float> normals = {},
              std::vector<Point3>* turns = nullptr);

  /// Scales the motion of each vertex in later poses by its share, 0 to 1; empty: no scaling.
  void set_mask(std::span<const float> shares);
  /// Replaces the shape that the cage deforms, three numbers a vertex; empty: the model at rest.
  void set_shape(std::span<const double> positions);
  /// Sets the probes, which act after the cage.
  void set_probes(const std::vector<Probe>& probes);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Shapes of one mesh, blended in log space: halfway to 180 degrees is 90 degrees. Not thread-safe.
class ShapeSpace {
public:
  /// shapes: vertex positions, in order of motion: each rotation continues from the shape before.
  ShapeSpace(const Mesh& rest, std::span<const std::vector<Point3>> shapes, int threads = 0,
             const Watch& watch = {});
  ~ShapeSpace();
  ShapeSpace(ShapeSpace&&) noexcept;
  ShapeSpace& operator=(ShapeSpace&&) noexcept;

  std::size_t shape_count() const;
  /// The logarithm of each triangle's map in a shape: six numbers of the stretch (xx xy xz yy yz zz) and a
  /// rotation vector, relative to the global rotation of the shape.
  std::vector<std::array<double, 9>> vector(std::size_t shape) const;
  /// The weighted sum of the shapes: all weights 0 is the rest shape, (1, 0, ...) the first shape.
  std::vector<Point3> mix(std::span<const double> weights) const;
  /// Interpolates along the sequence of shapes: 0 is the first, 1 the second, 0.5 halfway. straight: moves
  /// vertices along straight lines.
  std::vector<Point3> between(double at, bool straight = false) const;
  /// Example-based posing: the shape near the blends of the shapes whose given vertices lie at `places`.
  /// firmness: infinite makes places exact, 0.3 pulls as strongly as neighbouring vertices do. freedom: 0
  /// follows the shapes, 1 is as rigid as possible. weights, if not null, receives the weight of each shape.
  std::vector<Point3> pose(std::span<const std::uint32_t> vertices, std::span<const Point3> places,
                           double firmness = 1e300, double freedom = 0.3,
                           std::vector<double>* weights = nullptr, const Watch& watch = {}) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Poses of a cage in log space, as ShapeSpace. The cage's parts keep count of full rotations.
class PoseSpace {
public:
  PoseSpace(const Mesh& cage, std::span<const std::vector<Point3>> poses);
  ~PoseSpace();
  PoseSpace(PoseSpace&&) noexcept;
  PoseSpace& operator=(PoseSpace&&) noexcept;

  std::size_t pose_count() const;
  std::vector<std::array<double, 9>> vector(std::size_t pose) const;
  std::vector<Point3> mix(std::span<const double> weights) const;
  std::vector<Point3> between(double at, bool straight = false) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A session saved by the window: the posed model, and the model at frames of the timeline. Not thread-safe.
class Session {
public:
  explicit Session(const std::filesystem::path& file);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  Mesh model() const;                ///< at rest
  Mesh cage() const;                 ///< at rest; empty without a cage
  std::vector<Point3> pose() const;  ///< the cage's vertex positions
  /// The first and the last frame; both are 1 without keys.
  std::array<int, 2> range() const;
  const std::vector<std::string>& notes() const;
  /// The model's vertices at a frame, as written by `viete animate`. Without keys: the current pose.
  std::vector<Point3> frame(double frame) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viete
