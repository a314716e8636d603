#include "app/exporter.h"

#include <stdlib.h>
#include <algorithm>
#include <system_error>
#include <utility>

#include "app/child_process.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "base/numbered_files.h"
#include "base/text.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

// A temporary folder. The destructor deletes the folder with its contents.
class ScratchFolder {
public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "viete-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw base::Error(name, "no folder can be created there",
                        "set TMPDIR to a writable folder with free space");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

}  // namespace

std::vector<std::string> write_pictures_in_child(const PictureExport& what, base::Progress& progress) {
  const ScratchFolder scratch;
  const fs::path session = scratch.path() / "animation.viete";
  base::replace_file(session, files::session_text(what.session, session), base::Durability::process);
  std::vector<std::string> words{what.program.string(), "animate", session.string(), "-o",
                                 fs::absolute(what.file).string()};
  if (what.session.view.cage) words.push_back("--show-cage");
  if (what.panels) words.push_back("--panels");
  if (what.replaces) words.push_back("--force");
  return run_child(words, progress);
}

void Exporter::add(files::Export what, std::vector<std::string> shown_notes) {
  const std::filesystem::path file = what.file;
  add({file, "no file was changed",
       [what = std::move(what)](base::Progress& progress) {
         return Written{"", files::write_deformed(what, &progress)};
       },
       std::move(shown_notes)});
}

void Exporter::add(files::AnimationExport what, std::vector<std::string> shown_notes) {
  const std::filesystem::path file = what.model.file;
  const bool numbered = base::NumberedName::is_pattern(file);
  add({file, numbered ? "frames written so far are complete" : "no file was changed",
       [what = std::move(what)](base::Progress& progress) {
         files::AnimationReport report = files::write_animation(what, &progress);
         const std::string name = what.model.file.filename().string();
         return Written{name + ": " + report.summary, std::move(report.notes)};
       },
       std::move(shown_notes)});
}

void Exporter::add(PictureExport what) {
  const std::filesystem::path file = what.file;
  add({file, "pictures written so far are complete", [what = std::move(what)](base::Progress& progress) {
         return Written{"", write_pictures_in_child(what, progress)};
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
  job_.start(std::move(now_.write), "Exporting " + now_.file.filename().string());
}

workspace::WorkState Exporter::state() const {
  if (!running()) return {};
  workspace::WorkState state = job_.state();
  if (!waiting_.empty()) state.what += ", then " + waiting_.front().file.filename().string();
  return state;
}

// Shows one message. Notes and the summary are only listed in the Messages panel.
void Exporter::tell(workspace::Messages& messages, Written&& written) const {
  std::erase_if(written.notes,
                [&](const std::string& note) { return std::ranges::count(now_.shown_notes, note) > 0; });
  std::string command;  // makes a film of the pictures
  std::erase_if(written.notes, [&](const std::string& note) {
    const bool found = note.starts_with("ffmpeg ");
    if (found) command = note;
    return found;
  });
  if (!written.summary.empty()) messages.log(workspace::Severity::info, written.summary);
  for (const auto& note : written.notes) messages.log(workspace::Severity::warning, note);
  if (!command.empty()) messages.log(workspace::Severity::info, command);
  std::string text = "Saved " + now_.file.filename().string();
  if (!written.notes.empty()) text += " (" + base::counted(written.notes.size(), "note") + ", see Messages)";
  messages.info(text + ".");
}

std::optional<Exporter::Failure> Exporter::follow(workspace::Messages& messages, bool wait) {
  auto result = job_.poll(wait);
  if (!result) return std::nullopt;
  std::optional<Failure> failure;
  if (result->value) {
    messages.succeeded("export");
    tell(messages, *std::move(result->value));
  } else if (result->stopped) {
    messages.info("Cancelled exporting " + now_.file.filename().string() + "; " + now_.stopped + ".");
  } else {
    failure = {now_.file, result->problem};
  }
  start_next();
  return failure;
}

}  // namespace viete::app
