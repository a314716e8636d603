// Files opened at once.
#pragma once

#include <doctest/doctest.h>

#include <utility>

#include "scene/workspace/taking.h"
#include "scene/workspace/workspace.h"

namespace viete::test {

// A session, or a model with its cage.
inline scene::Workspace opened(std::vector<std::filesystem::path> files) {
  scene::Workspace workspace;
  REQUIRE(scene::open_now(workspace, {scene::OpenRequest::What::model, std::move(files)}));
  return workspace;
}

inline bool load_model(scene::Workspace& workspace, const std::filesystem::path& model,
                       const std::filesystem::path& cage) {
  return scene::open_now(workspace, {scene::OpenRequest::What::model, {model, cage}});
}

inline bool load_cage(scene::Workspace& workspace, const std::filesystem::path& cage) {
  return scene::open_now(workspace, {scene::OpenRequest::What::cage, {cage}});
}

inline bool load_pose(scene::Workspace& workspace, const std::filesystem::path& pose) {
  return scene::open_now(workspace, {scene::OpenRequest::What::pose, {pose}});
}

}  // namespace viete::test
