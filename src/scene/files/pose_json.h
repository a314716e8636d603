// Poses, named poses and timeline keys as parts of a session.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/document/document_state.h"
#include "scene/files/json_file.h"

namespace viete::scene {

/// "turns": rotation vectors in radians, one per part of the cage; "positions": [x, y, z] per cage vertex.
nlohmann::ordered_json pose_json(const deform::Pose& pose);
/// An unreadable position becomes NaN, with a warning; the caller replaces it by the rest position.
deform::Pose pose_of(const JsonReader& json, std::vector<std::string>& warnings);

/// The poses of probes in order: [{"turned": [x, y, z], rotation vector in radians,
///   "stretched": [xx, xy, xz, yy, yz, zz], log of the stretch, "moved": [x, y, z]}, ...]; missing: 0.
void put_probe_pose(nlohmann::ordered_json& json, const deform::ProbePose& pose);
deform::ProbePose probe_pose_of(const JsonReader& json);

/// A list of unique shapes of the model, referenced by poses with 0-based indices: [{"float32", or "float64"
/// if float is not exact: base64 of x, y, z of each vertex, little-endian}, ...]
class ShapeTable {
public:
  std::size_t number_of(const SharedShape& shape);
  nlohmann::ordered_json json() const;

private:
  std::vector<SharedShape> shapes_;
  std::map<const void*, std::size_t> numbers_;
};
/// Damaged shapes are null, with a warning.
std::vector<SharedShape> shapes_of(const JsonReader& json, std::vector<std::string>& warnings);
SharedShape shape_of(const JsonReader& number, std::span<const SharedShape> shapes);

/// "turns", "positions": as in a pose, missing without a cage; "probes": as above, missing: none; "shape":
/// its index, missing: at rest.
nlohmann::ordered_json whole_pose_json(const WholePose& pose, ShapeTable& shapes);
SharedPose whole_pose_of(const JsonReader& json, std::span<const SharedShape> shapes,
                         std::vector<std::string>& warnings);

/// [{"name", "weight": percent, missing: 0, "part": cage vertices that it moves, missing: all,
///   and a pose as above}, ...]
nlohmann::ordered_json library_json(const PoseLibrary& library, ShapeTable& shapes);

/// {"first", "last": playback range, "rate": frames per second, "frame": current, "repeat": "once", "loop" or
///  "ping_pong", "straight": true (linear) or missing,
///  "keys": [{"frame", "easing": "smooth", "linear" or "hold", "mix": [{"name" of a pose, "weight": percent},
///            ...] it was mixed from, and a pose as above}, ...],
///  "unkeyed": [{"frame", and a pose as above}, ...], poses that undo can restore, oldest first; missing:
///             none,
///  "cameras": [{"frame", and a camera as in camera_json.h}, ...]}
nlohmann::ordered_json timeline_json(const Timeline& timeline, double frame, ShapeTable& shapes);

/// A damaged pose is skipped with a warning. Sizes are not checked: see fit_poses().
PoseLibrary library_of(const JsonReader& json, std::span<const SharedShape> shapes,
                       std::vector<std::string>& warnings);
Timeline timeline_of(const JsonReader& json, double& frame, std::span<const SharedShape> shapes,
                     std::vector<std::string>& warnings);

/// Removes poses and keys that do not fit `cage` (null: none), or whose shapes do not fit the model, with a
/// warning naming `file`; unreadable positions become the rest positions.
void fit_poses(PoseLibrary& library, Timeline& timeline, const deform::Cage* cage, const mesh::Surface& model,
               const std::string& file, std::vector<std::string>& warnings);

}  // namespace viete::scene
