// Opens files synchronously.
#pragma once

#include "scene/workspace/apply_opened.h"
#include "scene/workspace/workspace.h"

namespace viete::test {

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
