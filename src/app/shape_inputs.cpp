#include "app/shape_inputs.h"

#include <algorithm>
#include <utility>

#include "app/inputs.h"
#include "app/options.h"
#include "app/terminal_progress.h"
#include "base/error.h"
#include "mesh/triangle.h"

namespace viete::app {

namespace {

void check(const Output& output, const FilesInUse& files, const scene::FrameSteps* frames) {
  if (!frames) return check_output(output.file, output.content, files, output.force);
  check_output(output.file, *frames, files, force_of(output.force));
}

// Logs are of triangles.
void check_has_area(const std::filesystem::path& file, const mesh::Surface& model) {
  const auto& p = model.positions;
  const auto has_area = [&](const mesh::Triangle& t) { return mesh::has_area(p[t[0]], p[t[1]], p[t[2]]); };
  if (std::ranges::none_of(model.triangles, has_area))
    throw base::Error(file.string(), "no face of this model has an area",
                      "choose another one as the model at rest");
}

}  // namespace

OpenedShapes open_shapes(const std::filesystem::path& model, std::span<const std::filesystem::path> shapes,
                         const Output& output, const scene::FrameSteps* frames) {
  FilesInUse named;
  named.add(model, scene::the_model);
  for (const auto& file : shapes) named.add(file, scene::a_shape);
  check(output, named, frames);
  if (scene::is_session(model))
    throw base::Error(model.string(), "this is a session, and shapes are of a model",
                      "name the model itself");
  OpenedShapes all;
  {
    TerminalProgress work("Reading " + model.filename().string());
    all.model = scene::open_files({scene::OpenRequest::What::model, {model}}, {}, &work.progress());
    scene::check_drawable(all.model);
    const mesh::Surface& surface = *all.model.document->model.surface;
    check_has_area(model, surface);
    scene::check_shape_count(model.string(), shapes.size(), surface);
    for (const auto& file : shapes) {
      scene::ImportedShapes read = scene::read_shapes({&file, 1}, surface, &work.progress());
      all.of_files.push_back(std::move(read.shapes));
      for (auto& path : read.files) all.model.also_read.push_back({std::move(path), scene::a_shape});
      for (auto& warning : read.warnings) all.model.warnings.push_back(std::move(warning));
    }
  }
  check(output, scene::files_of(all.model), frames);
  print_notes(all.model.warnings);
  return all;
}

std::vector<std::string> write_shape(const scene::Export& what, const std::string& name,
                                     base::Progress* progress) {
  if (!scene::in_range({{}, {}, what.shape}))
    throw base::Error(what.file.string(), name + " is larger than can be drawn",
                      "take smaller weights, and places nearer to the model");
  return scene::write_exact(what, {what.shape ? *what.shape : what.model->positions, {}, {}, 0}, progress);
}

int unless_stopped(const std::filesystem::path& output, const std::function<int()>& write) {
  try {
    return write();
  } catch (const base::Cancelled&) {
    throw base::Error(output.string(), "stopped", "no file was changed");
  }
}

}  // namespace viete::app
