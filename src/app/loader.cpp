#include "app/loader.h"

#include <utility>

#include "document/document.h"
#include "weights/binding.h"

namespace viete::app {

namespace {

// Copies a request and makes the copy remove the fins of the cage. `cage`: the file of the cage.
files::OpenRequest without_fins(files::OpenRequest request, const std::string& cage) {
  using What = files::OpenRequest::What;
  request.without_fins = true;
  if (request.what != What::dropped) return request;
  if (request.files.front() == cage) std::swap(request.files.front(), request.files.back());
  request.what = request.files.size() == 1 ? What::cage : What::model;
  return request;
}

Loaded load(const files::OpenRequest& request, const document::Document& current, std::size_t moving,
            base::StepProgress& progress) {
  Loaded loaded;
  try {
    loaded.opened = files::open_files(request, current, &progress);
  } catch (const files::SessionFileError& error) {
    loaded.question = workspace::ask_to_locate(error.key, error.problem());
    loaded.request = request;
  } catch (const pose::FinError& error) {
    loaded.question = workspace::ask_to_remove_fins(error.place() + ": " + error.problem());
    loaded.request = without_fins(request, error.place());
  }
  if (loaded.question) return loaded;
  const files::Opened& opened = loaded.opened;
  files::check_drawable(opened);
  if (!opened.document) return loaded;
  const document::Document& document = *opened.document;
  if (document.model().surface != current.model().surface) {
    progress.section(0.8, 1);
    loaded.shading = shading_of(document.model(), moving);
  }
  if (!document.has_cage()) return loaded;
  progress.step(document::binding_plan(document, document.deformer().weighting));
  loaded.bound = app::bind(document.model().surface, document.cage(), document.deformer(), document.method(),
                           {}, progress, loaded.shading.draft);
  return loaded;
}

}  // namespace

void start_loading(Loader& loader, const files::OpenRequest& request, const document::Document& current,
                   std::size_t moving) {
  const auto& files = request.files;
  loader.start([request, current = current.without_history(),
                moving](base::StepProgress& progress) { return load(request, current, moving, progress); },
               "Reading " + (files.empty() ? "" : files.front().filename().string()));
}

}  // namespace viete::app
