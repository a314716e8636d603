// The frame, top to bottom: buffers and order of its links.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/worker_pool.h"
#include "deform/apply.h"
#include "deform/binding.h"
#include "deform/blend.h"
#include "deform/cage.h"
#include "deform/log_maps.h"
#include "sym3/exp.h"

namespace viete::deform {

/// `fused` stands for blend, exp and apply where they are one pass, `skeleton` for the blend of the vertices
/// that compressed weights interpolate.
enum class Link { face_maps, log_maps, blend, exp, apply, skeleton, fused, normals };
inline constexpr std::size_t link_count = 8;
std::string_view name(Link link);

/// Wall milliseconds of each link in one frame; links that the coordinates do not use stay 0.
struct LinkTimes {
  std::array<double, link_count> ms{};

  double& operator[](Link link) { return ms[static_cast<std::size_t>(link)]; }
  double operator[](Link link) const { return ms[static_cast<std::size_t>(link)]; }
  double total() const;
};

/// Throws base::Error if the pose has not one position per cage vertex.
void check_pose(const Cage& cage, const Pose& pose);

class FusedFrame;
class Weigher;

/// Owns the buffers of one bound model, and takes the path that the binding and the method allow: method
/// `fast` and mean value coordinates take the fused frame where the binding has tiles. Cage and binding are
/// shared and constant, so that a new binding can be made elsewhere while this one is in use. Not
/// thread-safe; everything that grows with the model is allocated in the constructor. Results are
/// bit-identical for any number of threads.
class Deformer {
public:
  /// cage and binding must not be null and belong together. Before the first frame positions are the rest
  /// positions.
  Deformer(std::shared_ptr<const Cage> cage, std::shared_ptr<const Binding> binding, base::WorkerPool& pool);

  ~Deformer();

  /// The path that deform() takes for the method; nothing if the binding is not for it.
  std::optional<Path> path(sym3::Method method) const;
  /// Tells that the poses from now on differ in the same few vertices, or that this is over: a fused frame
  /// then costs what moves.
  void set_dragging(bool on);
  /// One frame: positions and normals for the pose. Throws base::Error if pose.positions is not one per cage
  /// vertex. path(method) must not be nothing.
  void deform(const Pose& pose, sym3::Method method);

  /// After a fused frame made of its vertices when they are asked for.
  std::span<const mesh::Point> positions() const;
  std::span<const mesh::Point> normals() const;
  /// The last frame, if it was fused, as it left it; null otherwise.
  const FusedFrame* fused() const { return fused_ran_ ? fused_.get() : nullptr; }
  const LinkTimes& times() const { return times_; }
  /// Of the last frame; for mean value coordinates, which need no logs, only the pose's turns, handed on.
  const LogReport& report() const { return report_; }
  /// The matrices that the last frame exponentiated, after a fused frame those of a sample of vertices, made
  /// when they are asked for. Empty for mean value coordinates.
  std::span<const sym3::Sym3<double>> matrices() const;
  /// The cage's logs in the last frame; empty for mean value coordinates.
  std::span<const MapLog> logs() const;

  /// How far the last frame is from double precision and exact weights: the largest distance of a sample of
  /// vertices, in diagonals of the cage. 0 after a staged frame. Takes about a millisecond.
  double sampled_error() const;

private:
  void deform_faces(const Pose& pose, sym3::Method method);
  void deform_mean_value(const Pose& pose);
  void compute_normals();
  void allocate_staged();
  void take_vertices() const;

  std::shared_ptr<const Cage> cage_;
  std::shared_ptr<const Binding> binding_;
  base::WorkerPool& pool_;
  std::vector<FaceMap> maps_;
  std::vector<MapLog> logs_;
  std::vector<Vec3> posed_;  // mean value: the cage relative to the pose's origin
  BlendedLogs sums_;
  std::vector<sym3::Sym3<double>> stretches_;
  mutable std::vector<mesh::Point> positions_, normals_;
  mutable std::vector<sym3::Sym3<double>> sample_;
  std::unique_ptr<FusedFrame> fused_;
  std::unique_ptr<Weigher> weigher_;
  bool fused_ran_ = false;
  mutable bool vertices_taken_ = true, matrices_sampled_ = true;  // of the last fused frame
  LinkTimes times_;
  LogReport report_;
};

}  // namespace viete::deform
