// Opens files and waits until they are open.
#pragma once

#include "workspace/apply_opened.h"
#include "workspace/workspace.h"

namespace viete::test {

inline bool load_model(workspace::Workspace& workspace, const std::filesystem::path& model,
                       const std::filesystem::path& cage) {
  return workspace::open_now(workspace, {files::OpenRequest::What::model, {model, cage}});
}

inline bool load_cage(workspace::Workspace& workspace, const std::filesystem::path& cage) {
  return workspace::open_now(workspace, {files::OpenRequest::What::cage, {cage}});
}

inline bool load_pose(workspace::Workspace& workspace, const std::filesystem::path& pose) {
  return workspace::open_now(workspace, {files::OpenRequest::What::pose, {pose}});
}

}  // namespace viete::test
