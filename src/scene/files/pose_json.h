// Poses, those with names, and keys in time, as parts of a session.
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
/// A position that cannot be read is NaN, with a warning: it is to be at rest.
deform::Pose pose_of(const JsonReader& json, std::vector<std::string>& warnings);

/// The poses of probes in their order: [{"turned": [x, y, z], rotation vector in radians,
///   "stretched": [xx, xy, xz, yy, yz, zz], log of the stretch, "moved": [x, y, z]}, ...]; what is missing is
///   0.
void put_probe_pose(nlohmann::ordered_json& json, const deform::ProbePose& pose);
deform::ProbePose probe_pose_of(const JsonReader& json);

/// Shapes of the model, each once; poses name them by their numbers, from 0:
/// [{"float32" or, where those would not do, "float64": base64 of x, y, z of each vertex, little-endian},
/// ...]
class ShapeTable {
public:
  std::size_t number_of(const SharedShape& shape);
  nlohmann::ordered_json json() const;

private:
  std::vector<SharedShape> shapes_;
  std::map<const void*, std::size_t> numbers_;
};
/// What is damaged is null, with a warning.
std::vector<SharedShape> shapes_of(const JsonReader& json, std::vector<std::string>& warnings);
SharedShape shape_of(const JsonReader& number, std::span<const SharedShape> shapes);

/// "turns", "positions": as of a pose, missing without a cage; "probes": as above, missing: none; "shape":
/// its number, missing: at rest.
nlohmann::ordered_json whole_pose_json(const WholePose& pose, ShapeTable& shapes);
SharedPose whole_pose_of(const JsonReader& json, std::span<const SharedShape> shapes,
                         std::vector<std::string>& warnings);

/// [{"name", "weight": percent, missing: 0, "part": vertices of the cage that it moves, missing: all,
///   and a pose as above}, ...]
nlohmann::ordered_json library_json(const PoseLibrary& library, ShapeTable& shapes);

/// {"first", "last": what plays, "rate": frames a second, "frame": where it is, "repeat": "once", "loop" or
///  "ping_pong", "straight": true or missing,
///  "keys": [{"frame", "easing": "smooth", "linear" or "hold", "mix": [{"name" of a pose, "weight": percent},
///            ...] that it was made of, and a pose as above}, ...],
///  "unkeyed": [{"frame", and a pose as above}, ...], those that undo leads back to, oldest first; missing:
///             none,
///  "cameras": [{"frame", and a camera as in camera_json.h}, ...]}
nlohmann::ordered_json timeline_json(const Timeline& timeline, double frame, ShapeTable& shapes);

/// A pose that is damaged is left out, and a warning says so; so is what does not fit in size: see
/// fit_poses().
PoseLibrary library_of(const JsonReader& json, std::span<const SharedShape> shapes,
                       std::vector<std::string>& warnings);
Timeline timeline_of(const JsonReader& json, double& frame, std::span<const SharedShape> shapes,
                     std::vector<std::string>& warnings);

/// Poses and keys that are not of `cage` (null: none), or whose shapes are not of the model, are dropped,
/// with a warning of the file; positions that could not be read are those at rest.
void fit_poses(PoseLibrary& library, Timeline& timeline, const deform::Cage* cage, const mesh::Surface& model,
               const std::string& file, std::vector<std::string>& warnings);

}  // namespace viete::scene
