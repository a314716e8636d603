// Opens files and waits until they are open.
#pragma once

#include "workspace/open_save.h"
#include "workspace/workspace.h"

namespace viete::test {

/// Reads the files and applies them. On failure, shows the error, changes nothing and returns false.
inline bool open_now(workspace::Workspace& w, const files::OpenRequest& request) {
  try {
    files::Opened opened = files::open_files(request, w.document);
    files::check_drawable(opened);
    workspace::apply_opened(w, std::move(opened));
    return true;
  } catch (const std::exception& error) {
    w.messages.error(error.what(), {"open"});
    return false;
  }
}

inline bool load_model(workspace::Workspace& workspace, const std::filesystem::path& model,
                       const std::filesystem::path& cage) {
  return open_now(workspace, {files::OpenRequest::What::model, {model, cage}});
}

inline bool load_cage(workspace::Workspace& workspace, const std::filesystem::path& cage) {
  return open_now(workspace, {files::OpenRequest::What::cage, {cage}});
}

inline bool load_pose(workspace::Workspace& workspace, const std::filesystem::path& pose) {
  return open_now(workspace, {files::OpenRequest::What::pose, {pose}});
}

}  // namespace viete::test
