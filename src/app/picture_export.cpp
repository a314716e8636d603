#include "app/picture_export.h"

#include <stdlib.h>

#include <charconv>
#include <chrono>
#include <sstream>
#include <system_error>
#include <thread>

#include "base/atomic_file.h"
#include "base/child_program.h"
#include "base/error.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

// Gone with what it holds.
class ScratchFolder {
public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "viete-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw base::Error(name, "no folder can be made there", "set TMPDIR to one with space");
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

// "37 %" is how far it is; whatever else is a sentence.
struct Said {
  double done = 0;
  std::vector<std::string> sentences;
};

Said said_by(const base::ChildProgram& child) {
  Said said;
  std::istringstream lines(child.said());
  for (std::string line; std::getline(lines, line);) {
    int percent = 0;
    const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), percent);
    if (problem == std::errc() && std::string_view(end) == " %") {
      said.done = 0.01 * percent;
    } else if (!line.empty()) {
      said.sentences.push_back(line.starts_with("viete: ") ? line.substr(7) : line);
    }
  }
  return said;
}

}  // namespace

std::vector<std::string> write_pictures_aside(const PictureExport& what, base::Progress& progress) {
  constexpr auto look_again = std::chrono::milliseconds(50);
  const ScratchFolder scratch;
  const fs::path session = scratch.path() / "animation.viete";
  base::replace_file(session, scene::session_text(what.session, session), base::Durability::process);
  std::vector<std::string> words{what.program.string(), "animate", session.string(), "-o",
                                 fs::absolute(what.file).string()};
  if (what.panels) words.push_back("--panels");
  base::ChildProgram child(words, "start this program again", {"VIETE_PROGRESS=1"});
  try {
    while (child.running()) {
      std::this_thread::sleep_for(look_again);
      progress.report(said_by(child).done);
    }
  } catch (const base::Cancelled&) {
    child.stop();
    while (child.running()) std::this_thread::sleep_for(look_again);
    throw;
  }
  std::vector<std::string> sentences = said_by(child).sentences;
  try {
    child.finish();
  } catch (const base::Error&) {
    if (sentences.empty()) throw;
    throw base::Error("", sentences.back());
  }
  return sentences;
}

}  // namespace viete::app
