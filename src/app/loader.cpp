#include "app/loader.h"

#include <utility>

#include "base/clock.h"
#include "deform/binding.h"
#include "scene/document/binding_plan.h"

namespace viete::app {

namespace {

// Omits the undo history, which may be large and is not needed for reading.
scene::Document without_history(const scene::Document& document) {
  scene::Document copy;
  copy.model = document.model;
  copy.cage_file = document.cage_file;
  copy.cage = document.cage;
  copy.mask = document.mask;
  copy.probes = document.probes;
  copy.shape = document.shape;
  copy.library = document.library;
  copy.method = document.method;
  copy.scheme = document.scheme;
  copy.timeline = document.timeline;
  return copy;
}

}  // namespace

void Loader::Part::begin(std::string name) {
  const std::lock_guard lock(mutex);
  what = std::move(name);
  begun = base::wall_seconds();
}

Loader::Loaded Loader::load(const scene::OpenRequest& request, const scene::Document& current, Part& part,
                            base::Progress& progress) {
  Loaded loaded;
  try {
    loaded.opened = scene::open_files(request, current, &progress);
  } catch (const scene::SessionFileError& error) {
    loaded.question = scene::ask_to_locate(error.key, error.problem());
  } catch (const scene::FinError& error) {
    loaded.question = scene::ask_to_remove_fins(error.place() + ": " + error.problem());
  }
  if (loaded.question) return loaded.request = request, loaded;
  const scene::Opened& opened = loaded.opened;
  scene::check_drawable(opened);
  if (!opened.document) return loaded;
  const scene::Document& document = *opened.document;
  if (document.model.surface != current.model.surface) {
    progress.section(0.8, 1);
    loaded.shading = shading_of(document.model.surface, document.model.attributes.get());
  }
  progress.section(1, 1);
  if (!document.has_cage()) return loaded;
  part.binds = true;
  part.begin(scene::text(scene::binding_plan(document, document.scheme.weighting)));
  progress.section(0, 1);
  loaded.bound =
      app::bind(document.model.surface, document.cage, document.scheme, document.method, {}, progress);
  return loaded;
}

void Loader::start(const scene::OpenRequest& request, const scene::Document& current) {
  const auto& files = request.files;
  part_ = std::make_shared<Part>();
  part_->begin("Reading " + (files.empty() ? "" : files.front().filename().string()));
  job_.start([request, current = without_history(current), part = part_](base::Progress& progress) {
    return load(request, current, *part, progress);
  });
}

scene::WorkState Loader::state() const {
  if (!running()) return {};
  const std::lock_guard lock(part_->mutex);
  return {true, part_->what, job_.done(), base::wall_seconds() - part_->begun, job_.seconds()};
}

}  // namespace viete::app
