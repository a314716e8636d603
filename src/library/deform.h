// Cage-based mesh deformation that blends rotations and stretches in log space. This header is the complete
// C++ interface.
//
// A Deformer binds a model to a cage once. Each pose of the cage then gives the positions of the model's
// vertices. The chapter "Deformers" of the manual explains the settings. Points are x, y, z; angles are in
// radians. Functions throw std::runtime_error; the message says what is wrong and what to do. The number of
// threads does not change the results. A moved-from object can only be destroyed or assigned to.
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
#include <utility>
#include <vector>

namespace viete {

using Point3 = std::array<double, 3>;

/// Points to the private members of a class, so that the class can be moved but not copied.
template <class Impl>
using Hidden = std::unique_ptr<Impl, void (*)(Impl*)>;

/// Long work calls this function several times a second, in the calling thread, with the finished fraction
/// from 0 to 1. If the function throws an exception, the work is cancelled and the caller gets the exception.
using Watch = std::function<void(double done)>;

/// File content other than vertices and faces: materials, texture coordinates, groups, comments.
struct FileContent;

/// A polygon mesh. Seen from outside, the corners of a face are in counter-clockwise order.
struct Mesh {
  std::vector<Point3> vertices;
  std::vector<std::uint32_t> corners;  ///< vertex indices of all faces, one face after the other
  /// Face f has the corners [starts[f], starts[f + 1]). `starts` has face_count() + 1 entries.
  std::vector<std::uint32_t> starts;
  /// Set by read_mesh(). If the faces have not changed, write_mesh() writes this content again.
  std::shared_ptr<const FileContent> file{};

  std::size_t face_count() const { return starts.empty() ? 0 : starts.size() - 1; }
};

/// Reads or writes OBJ, PLY, OFF, STL or glTF. The file extension chooses the format. If the program
/// viete-import is installed, also reads FBX, Collada and other formats, and compressed glTF. Writing is
/// atomic. STL and glTF files do not keep the vertex order and the polygons. If `notes` is not null, it gets
/// warnings, one line each, for example about content that the format does not support.
Mesh read_mesh(const std::filesystem::path& file, std::vector<std::string>* notes = nullptr);
void write_mesh(const std::filesystem::path& file, const Mesh& mesh,
                std::vector<std::string>* notes = nullptr);

/// Parameters of make_cage(). If a value is out of range, make_cage() throws an error.
struct CageWish {
  std::string kind = "automatic";  ///< "automatic" or "box"
  std::size_t triangles = 200;     ///< approximate number, 12 to 20000; for automatic cages only
  double margin = 0.0015;          ///< distance to the model, as a fraction of its diagonal, 0.0005 to 0.2
  double gap = 0.005;              ///< closes gaps up to twice this fraction of the diagonal; 0 to 0.2
  std::string symmetry = "auto";   ///< normal of the mirror plane: "auto", "none", "x", "y" or "z"
  bool quads = false;              ///< joins pairs of triangles into quads if the quads are good
  std::array<std::size_t, 3> cells{1, 1, 1};  ///< number of boxes along each axis; for box cages only
  bool own_axes = false;                      ///< aligns box cages with the model's principal axes
};
/// Makes a closed cage around the model, without self-intersections.
Mesh make_cage(const Mesh& model, const CageWish& wish = {}, const Watch& watch = {});

/// How the cage moves the model. `viete help deformers` describes all names and numbers. Numbers here are
/// fractions where the command line and the window have percentages. An empty member means the default of the
/// deformer.
struct Blending {
  std::string deformer = "smooth";  ///< "smooth", "paper", "mean-value", "rigid", "arap", "local"
  std::string weights{}, blend{};   ///< replace the weights and the blend of the deformer
  std::optional<double> radius{};   ///< distance at which weights become 0, in cage sizes, 0.001 to 10
  std::optional<double> rotation{}, stretch{};  ///< factors of the rotations and of the stretches, 0 to 2
  bool arap = false;                            ///< solves for a mesh that is as rigid as possible
  std::optional<int> iterations{};              ///< ARAP: number of solves, 1 to 20
  std::optional<double> attach{}, hold{};       ///< ARAP: distance in cage sizes, strength; each 0 to 1
  std::string method = "fast";  ///< method for matrices: "diag", "sd", "improved_sd" or "fast"
};

/// A model bound to a cage. Threads may use different deformers at the same time, but not the same deformer.
/// fork() waits until calls in other threads have ended. The child process uses one thread.
class Deformer {
public:
  /// Checks and copies the arguments. If `threads` is 0, uses one thread for each processor.
  Deformer(const Mesh& model, const Mesh& cage, const Blending& blending = {}, int threads = 0);

  /// Binds for the float or the double version of deform(), in up to some seconds. Without this call, the
  /// first deform() binds. The memory use is proportional to vertices * cage triangles.
  void bind(bool in_float, const Watch& watch = {});

  std::size_t vertex_count() const;
  /// Warnings about the cage, one line each.
  const std::vector<std::string>& notes() const;

  /// Computes the model's vertices from the cage's vertices. All spans have three numbers for each vertex. If
  /// `normals` is not empty, it gets unit vectors.
  /// The double version gives the same bits as `viete deform`. The float version is three to nine times as
  /// fast. Its compressed weights cause errors of up to 1e-4 (usually 1e-5) of the cage's diagonal, at rest
  /// or posed, and its normals are accurate to 1e-4.
  /// `turns` counts full turns: it has a rotation vector for each part of the cage. Pass an empty list for
  /// the first pose, and the same list for each later pose. If null, each part has its shortest rotation.
  void deform(std::span<const double> cage, std::span<double> positions, std::span<double> normals = {},
              std::vector<Point3>* turns = nullptr);
  void deform(std::span<const double> cage, std::span<float> positions, std::span<float> normals = {},
              std::vector<Point3>* turns = nullptr);

  /// Scales the motion of each vertex by a factor from 0 to 1. An empty span removes the scaling.
  void set_mask(std::span<const float> shares);
  /// Sets the shape that the cage deforms, three numbers for each vertex. Empty means the model at rest.
  void set_shape(std::span<const double> positions);

private:
  struct Impl;
  Hidden<Impl> impl_;
};

/// A capture of Gaussian splats. Never changes; copies share the data. Thread-safe.
class Splats {
public:
  /// Reads a PLY file whose vertices have scale_0, rot_0 and opacity, or an SPZ file.
  explicit Splats(const std::filesystem::path& file);

  // One entry per splat, as in PLY files of captures.
  std::vector<Point3> vertices() const;                      ///< the centres
  std::span<const std::array<float, 3>> log_scales() const;  ///< logarithms of the standard deviations
  std::span<const std::array<float, 4>> rotations() const;   ///< quaternions w, x, y, z of any length
  std::span<const float> opacities() const;                  ///< logits
  std::span<const std::array<float, 3>> colors() const;      ///< constant harmonics of red, green, blue
  /// The other spherical harmonics: first the 3, 8 or 15 of red, then of green, then of blue.
  std::span<const float> harmonics() const;
  /// Warnings about the file, one line each.
  const std::vector<std::string>& notes() const;

  /// Deforms centres, sizes, rotations and colours. `pose` has three numbers for each vertex of the cage.
  /// Gives the same bits as `viete deform`. `threads` is as for Deformer.
  Splats deformed(const Mesh& cage, std::span<const double> pose, const Blending& blending = {},
                  int threads = 0, const Watch& watch = {}) const;
  /// Writes all content of the file, atomically. Other formats than PLY and SPZ get only the centres. Returns
  /// warnings.
  std::vector<std::string> write(const std::filesystem::path& file) const;

private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
  explicit Splats(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
};

/// Blends shapes of a mesh in log space: halfway to 180 degrees is 90 degrees. Not thread-safe.
class ShapeSpace {
public:
  /// `shapes` are vertex positions in the order of the motion. The rotations of each shape continue the
  /// rotations of the previous shape.
  ShapeSpace(const Mesh& rest, std::span<const std::vector<Point3>> shapes, int threads = 0,
             const Watch& watch = {});

  /// The weighted sum of the shapes: (1, 0, ...) gives the first shape, and zeros give the rest shape.
  std::vector<Point3> mix(std::span<const double> weights) const;
  /// Interpolates the sequence of shapes: 0 is the first shape, 1 the second, 0.5 is halfway. If `linear`
  /// is true, vertices move along straight lines.
  std::vector<Point3> between(double at, bool linear = false) const;
  /// Example-based posing: moves `vertices` to `places`. All other vertices follow a blend of the shapes.
  /// `firmness` is the strength of the places: infinity is exact, 1 is about as strong as the pull of the
  /// neighbouring vertices, 0.3 is soft. `freedom`: with 0, the result is exactly a blend; with 1, it is as
  /// rigid as possible. If `weights` is not null, it gets the weight of each shape.
  std::vector<Point3> pose(std::span<const std::uint32_t> vertices, std::span<const Point3> places,
                           double firmness = 1e300, double freedom = 0.3,
                           std::vector<double>* weights = nullptr, const Watch& watch = {}) const;

private:
  struct Impl;
  Hidden<Impl> impl_;
};

/// Blends poses of a cage in log space, like ShapeSpace. Counts full turns of the cage's parts.
class PoseSpace {
public:
  PoseSpace(const Mesh& cage, std::span<const std::vector<Point3>> poses);

  std::vector<Point3> mix(std::span<const double> weights) const;
  std::vector<Point3> between(double at, bool linear = false) const;

private:
  struct Impl;
  Hidden<Impl> impl_;
};

/// A session file saved by the window, with a model and its animation. Not thread-safe.
class Session {
public:
  explicit Session(const std::filesystem::path& file);

  Mesh model() const;  ///< the model at rest
  /// The first and the last frame. If the timeline has no keys, both numbers are 1.
  std::array<int, 2> range() const;
  const std::vector<std::string>& notes() const;
  /// Returns the model's vertices at a frame, as in `viete animate`. Without keys, uses the current pose.
  std::vector<Point3> frame(double frame) const;

private:
  struct Impl;
  Hidden<Impl> impl_;
};

}  // namespace viete
