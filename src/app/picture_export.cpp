#include "app/picture_export.h"

#include <stdlib.h>

#include <system_error>

#include "app/aside.h"
#include "base/atomic_file.h"
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

}  // namespace

std::vector<std::string> write_pictures_aside(const PictureExport& what, base::Progress& progress) {
  const ScratchFolder scratch;
  const fs::path session = scratch.path() / "animation.viete";
  base::replace_file(session, scene::session_text(what.session, session), base::Durability::process);
  std::vector<std::string> words{what.program.string(), "animate", session.string(), "-o",
                                 fs::absolute(what.file).string()};
  if (what.session.view.cage) words.push_back("--show-cage");
  if (what.panels) words.push_back("--panels");
  return run_aside(words, progress);
}

}  // namespace viete::app
