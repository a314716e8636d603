#include "app/exporter.h"

#include <utility>

#include "base/numbered_files.h"
#include "base/quantity.h"

namespace viete::app {

void Exporter::add(scene::Export what) {
  const std::filesystem::path file = what.file;
  add({file, "no file was changed", [what = std::move(what)](base::Progress& progress) {
         return Written{"Saved the deformed model to " + what.file.string(),
                        scene::write_deformed(what, &progress)};
       }});
}

void Exporter::add(scene::AnimationExport what) {
  const std::filesystem::path file = what.model.file;
  const bool numbered = base::NumberedName::is_pattern(file);
  add({file, numbered ? "frames that are there are whole" : "no file was changed",
       [what = std::move(what)](base::Progress& progress) {
         scene::AnimationReport report = scene::write_animation(what, &progress);
         std::string said = "Saved the animation to " + what.model.file.string() + ": " + report.summary;
         if (report.there > 0) said += "; " + base::with_thousands(report.there) + " were there already";
         return Written{std::move(said), std::move(report.notes)};
       }});
}

void Exporter::add(PictureExport what) {
  const std::filesystem::path file = what.file;
  const bool numbered = base::NumberedName::is_pattern(file);
  add({file, numbered ? "pictures that are there are whole" : "no file was changed",
       [what = std::move(what)](base::Progress& progress) {
         std::vector<std::string> notes = write_pictures_aside(what, progress);
         return Written{"Saved the animation to " + what.file.string(), std::move(notes)};
       }});
}

void Exporter::add(Work work) {
  waiting_.push_back(std::move(work));
  if (!running()) start_next();
}

void Exporter::start_next() {
  if (waiting_.empty()) return;
  now_ = std::move(waiting_.front());
  waiting_.pop_front();
  job_.start(std::move(now_.write));
}

scene::WorkState Exporter::state() const {
  if (!running()) return {};
  std::string what = "Exporting " + now_.file.filename().string();
  if (!waiting_.empty()) what += ", then " + waiting_.front().file.filename().string();
  return {true, std::move(what), job_.done(), job_.seconds(), job_.seconds()};
}

std::optional<Exporter::Failure> Exporter::follow(scene::Messages& messages, bool wait) {
  const auto result = job_.poll(wait);
  if (!result) return std::nullopt;
  std::optional<Failure> failure;
  if (result->value) {
    for (const auto& note : result->value->notes) messages.warn(note);
    messages.succeeded("export");
    messages.info(result->value->said);
  } else if (result->stopped) {
    messages.info("Stopped exporting " + now_.file.filename().string() + "; " + now_.stopped + ".");
  } else {
    failure = {now_.file, result->problem};
  }
  start_next();
  return failure;
}

}  // namespace viete::app
