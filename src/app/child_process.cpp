#include "app/child_process.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/os.h"
#include "base/process.h"

namespace viete::app {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder()
    : path_(base::unused_name(fs::temp_directory_path() / ("viete-" + base::process_name()))) {
  std::error_code code;
  const bool created = fs::create_directory(path_, code);
  if (created) fs::permissions(path_, fs::perms::owner_all, code);
  if (!created || code)
    throw base::Error(path_.string(), "no folder can be created there",
                      "set TMPDIR to a writable folder with free space");
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> run_child(const std::vector<std::string>& words, base::Progress& progress) {
  base::ChildProgram child(words, "start this program again", {"VIETE_PROGRESS=1"});
  std::vector<std::string> lines = child.follow(progress);
  try {
    child.finish();
  } catch (const base::Error&) {
    if (lines.empty()) throw;
    throw base::Error("", lines.back());
  }
  return lines;
}

std::string create_and_show_report(const fs::path& program, const fs::path& state, base::Progress& progress) {
  const fs::path folder = (state.empty() ? fs::temp_directory_path() : state) / "report";
  std::error_code ignored;  // run_child() reports a missing folder
  fs::create_directories(folder.parent_path(), ignored);
  run_child({program.string(), "report", "--quick", "--force", "-o", folder.string()}, progress);
  const fs::path page = folder / "index.html";
  try {
    base::os::open_page(page);
  } catch (const base::Error& error) {
    return std::string("The report is complete. ") + error.what();
  }
  return "Opened the report in the browser: " + page.string();
}

}  // namespace viete::app
