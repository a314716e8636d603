// Deformation of models by cages in log space: the whole of it as one header, without OpenGL and without
// Eigen.
//
// A model is bound to a cage once; each pose of the cage then gives the model's vertices. What ways there
// are, and what they do, is in the manual's chapter on blending. Lengths are in the unit of the vertices,
// angles in radians, points are x, y, z. Everything throws std::runtime_error with one sentence: what is
// wrong, what to do. Results are the same bits for any number of threads. What was moved from is not called.
//
// Before 1.0 a new minor version may change this interface; it is compiled in and has no stable ABI.
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

/// Told some times a second, by the thread that called, how much of long work is done, 0 to 1. What it throws
/// ends the work, and is thrown by it.
using Watch = std::function<void(double done)>;

/// Polygons, counter-clockwise from outside.
struct Mesh {
  std::vector<Point3> vertices;
  std::vector<std::uint32_t> corners;  ///< of one face after the other, from 0
  std::vector<std::uint32_t>
      starts;  ///< face f has corners [starts[f], starts[f + 1]): one more than there are faces

  std::size_t face_count() const { return starts.empty() ? 0 : starts.size() - 1; }
};

/// Of a file: OBJ, PLY, OFF, STL, glTF, by the extension; written whole or not at all. STL and glTF keep
/// neither the order of vertices nor polygons. notes, if not null, gets what a person should know.
Mesh read_mesh(const std::filesystem::path& file, std::vector<std::string>* notes = nullptr);
void write_mesh(const std::filesystem::path& file, const Mesh& mesh);

struct CageWish {
  std::string kind = "automatic";  ///< "automatic" or "box"
  std::size_t triangles = 200;     ///< about so many, 12 to 20000; not of boxes
  double margin = 0.0015;          ///< distance to the model, in its diagonals, 0.0005 to 0.2
  double gap = 0.005;              ///< gaps narrower than twice this are closed, likewise, 0 to 0.2
  std::string symmetry = "auto";   ///< "auto", "none", "x", "y" or "z"
  bool quads = false;
  std::array<std::size_t, 3> cells{1, 1, 1};  ///< of boxes, along each axis
  bool own_axes = false;                      ///< of boxes: along the model's extents
};
/// A closed surface around the model, free of self-intersection.
Mesh make_cage(const Mesh& model, const CageWish& wish = {}, const Watch& watch = {});

/// How the cage moves the model; the words and numbers of the command line. What is left open is as the way
/// has it.
struct Blending {
  std::string way = "smooth";               ///< "smooth", "paper", "mean-value", "rigid", "arap", "local"
  std::string weights{}, blend{};           ///< in place of what the way has; empty: as it is
  std::optional<double> radius{};           ///< in sizes of the cage, 0.001 to 10
  std::optional<double> turn{}, stretch{};  ///< how much of rotations and stretches acts, 0 to 2
  std::optional<int> stitched{};            ///< how often it is solved for, 1 to 20
  std::optional<double> pins{}, hold{};     ///< of stitched models, 0 to 1
  std::string method = "fast";              ///< "diag", "sd", "improved_sd" or "fast"
};

/// A frame that moves, turns and stretches what is near it: y = place + exp(turn) exp(stretch) (x - place) +
/// move.
struct Probe {
  Point3 place{};                   ///< at rest
  double radius = 1;                ///< where it ends
  std::string falloff = "smooth";   ///< "smooth", "round", "linear", "sharp", "even", "endless"
  Point3 turn{};                    ///< a rotation vector
  std::array<double, 6> stretch{};  ///< the logarithm, upper triangle by rows: xx xy xz yy yz zz
  Point3 move{};
};

/// One model in one cage. For one thread at a time; several are independent. fork() waits for a deform() of
/// another thread to end; the child works with one thread.
class Deformer {
public:
  /// Checks and copies. threads: at most so many; 0 for all processors.
  Deformer(const Mesh& model, const Mesh& cage, const Blending& blending = {}, int threads = 0);
  ~Deformer();
  Deformer(Deformer&&) noexcept;
  Deformer& operator=(Deformer&&) noexcept;

  /// Binds for poses in float, or in double, which the first of them does otherwise: fractions of a second to
  /// some seconds, and memory in proportion to vertices times triangles of the cage.
  void bind(bool in_float, const Watch& watch = {});

  std::size_t vertex_count() const;
  std::size_t cage_vertex_count() const;
  /// Of the cage and of the binding, one line each.
  const std::vector<std::string>& notes() const;

  /// Positions of the cage's vertices to those of the model: three numbers a vertex. In double, as files are
  /// written (the bits of `viete deform`); in float as the window draws, with compressed weights, three to
  /// nine times as fast: off by up to 1e-4 of the larger diagonal of the cage, at rest or posed, usually by
  /// 1e-5, and by the rounding of the coordinates to float. normals may be empty, or get one of length 1 for
  /// each vertex. turns, if not null: whole turns of the cage's parts that the pose before had, one rotation
  /// vector each; this pose's come back. Without them each part turns the least.
  void deform(std::span<const double> cage, std::span<double> positions, std::span<double> normals = {},
              std::vector<Point3>* turns = nullptr);
  void deform(std::span<const double> cage, std::span<float> positions, std::span<float> normals = {},
              std::vector<Point3>* turns = nullptr);

  /// Of the next poses: how much of its motion each vertex makes, 0 to 1; empty: all of it.
  void set_mask(std::span<const float> shares);
  /// What the cage acts upon, three numbers a vertex; empty: the model at rest.
  void set_shape(std::span<const double> positions);
  /// A layer upon what the cage does.
  void set_probes(const std::vector<Probe>& probes);

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Shapes of one mesh in log space: halfway to a half turn is a quarter turn. For one thread at a time.
class ShapeSpace {
public:
  /// Shapes, positions of the vertices of the mesh at rest each, in the order of a motion: whole turns go on.
  ShapeSpace(const Mesh& rest, std::span<const std::vector<Point3>> shapes, int threads = 0,
             const Watch& watch = {});
  ~ShapeSpace();
  ShapeSpace(ShapeSpace&&) noexcept;
  ShapeSpace& operator=(ShapeSpace&&) noexcept;

  std::size_t shape_count() const;
  /// Of a shape, by number: the log of each triangle's map, six numbers of the stretch (xx xy xz yy yz zz),
  /// three of the rotation; after the whole turn of all.
  std::vector<std::array<double, 9>> vector(std::size_t shape) const;
  /// The sum of shapes, each times its weight: 0 is rest, (1, 0, ...) the first of them.
  std::vector<Point3> mix(std::span<const double> weights) const;
  /// The way through all of them: 0 is the first one, 1 the second, 0.5 halfway; straight: vertices on
  /// straight lines.
  std::vector<Point3> between(double at, bool straight = false) const;
  /// The shape among mixes, and near them, that has these vertices at these places. firmness: infinite holds,
  /// 0.3 pulls about as strongly as neighbours do; freedom 0: as the shapes say, 1: as rigid as can be.
  /// weights, if not null, gets those of the shapes.
  std::vector<Point3> pose(std::span<const std::uint32_t> vertices, std::span<const Point3> places,
                           double firmness = 1e300, double freedom = 0.3,
                           std::vector<double>* weights = nullptr, const Watch& watch = {}) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The same of poses of a cage, whose parts remember how often they turned.
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

/// A session of the window: its model as it is posed, and at the frames of its timeline. For one thread at a
/// time.
class Session {
public:
  explicit Session(const std::filesystem::path& file);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  Mesh model() const;                ///< at rest
  Mesh cage() const;                 ///< likewise; empty: there is none
  std::vector<Point3> pose() const;  ///< of the cage
  /// The first and the last frame; without keys both are 1.
  std::array<int, 2> range() const;
  const std::vector<std::string>& notes() const;
  /// Of the model, as `viete animate` writes them; without keys as it is posed, whatever the frame.
  std::vector<Point3> frame(double frame) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace viete
