#include "scene/document.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "base/error.h"
#include "deform/pose_io.h"
#include "mesh/read.h"

namespace viete::scene {

OpenedSurface open_surface(const std::filesystem::path& path, base::Progress* progress) {
  mesh::ReadResult read = mesh::read(path, progress);
  OpenedSurface opened;
  opened.path = path;
  opened.format = std::move(read.format);
  opened.facts = mesh::facts(read.surface);
  opened.bounds = mesh::used_bounds(read.surface);
  opened.warnings = std::move(read.warnings);
  opened.surface = std::make_shared<const mesh::Surface>(std::move(read.surface));
  return opened;
}

Document document_of(OpenedSurface model) {
  Document document;
  document.model = std::move(model);
  document.space = space_for(document.model.bounds);
  return document;
}

void check_drawable(const Document& document) {
  constexpr double least = 1e-32, most = 1e32;  // float ends near 1e-38 and 1e38
  for (const OpenedSurface* opened : {&document.model, &document.cage_file}) {
    if (!opened->surface) continue;
    const double size = opened->bounds.diagonal();
    if (size == 0 || (size >= least && size <= most)) continue;
    char text[64];
    std::snprintf(text, sizeof text, "a size of %.2g cannot be drawn", size);
    throw base::Error(opened->path.string(), text, "scale it to something between 1e-32 and 1e32");
  }
}

void set_cage(Document& document, OpenedSurface cage) {
  try {
    document.cage = std::make_shared<const deform::Cage>(deform::make_cage(*cage.surface));
  } catch (const base::Error& error) {
    throw base::Error(cage.path.string(), error.problem(), error.advice());
  }
  document.cage_file = std::move(cage);
  document.pose = deform::rest_pose(*document.cage);
  document.selection.clear();
  document.history = {};
}

Document open_document(const std::filesystem::path& model, const std::filesystem::path& cage,
                       base::Progress* progress) {
  Document document = document_of(open_surface(model, progress));
  if (!cage.empty()) set_cage(document, open_surface(cage));
  return document;
}

void set_pose(Document& document, deform::Pose pose) {
  document.history.record("open pose", {document.pose, document.selection});
  document.pose = std::move(pose);
  ++document.posed;
}

std::vector<std::string> open_pose(Document& document, const std::filesystem::path& path) {
  if (!document.has_cage()) {
    throw base::Error(path.string(), "a pose needs a cage and none is open", "open the cage first");
  }
  std::vector<std::string> warnings;
  set_pose(document, deform::read_pose(path, *document.cage, warnings));
  return warnings;
}

}  // namespace viete::scene
