#include "app/exporter.h"

#include <utility>

namespace viete::app {

void Exporter::add(scene::Export what) {
  waiting_.push_back(std::move(what));
  if (!running()) start_next();
}

void Exporter::start_next() {
  if (waiting_.empty()) return;
  file_ = waiting_.front().file;
  job_.start([what = std::move(waiting_.front())](base::Progress& progress) {
    return scene::write_deformed(what, &progress);
  });
  waiting_.pop_front();
}

scene::WorkState Exporter::state() const {
  if (!running()) return {};
  std::string what = "Exporting " + file_.filename().string();
  if (!waiting_.empty()) what += ", then " + waiting_.front().file.filename().string();
  return {true, std::move(what), job_.done(), job_.seconds(), job_.seconds()};
}

bool Exporter::follow(scene::Messages& messages, bool wait) {
  const auto result = job_.poll(wait);
  if (!result) return true;
  if (result->value) {
    for (const auto& note : *result->value) messages.warn(note);
    messages.succeeded("export");
    messages.info("Saved the deformed model to " + file_.string());
  } else if (result->stopped) {
    messages.info("Stopped exporting " + file_.filename().string() + "; no file was changed.");
  } else {
    messages.error(result->problem, {"export"});
  }
  start_next();
  return result->value || result->stopped;
}

}  // namespace viete::app
