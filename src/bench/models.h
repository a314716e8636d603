// Models, cages and poses of any size for the benchmarks.
#pragma once

#include <cstddef>
#include <filesystem>

#include "deform/cage.h"
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

}  // namespace viete::bench
