// Runs this program as a child process for long tasks, so that the view stays responsive.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::app {

/// A temporary folder for files that are passed to child processes. The destructor deletes the folder with
/// its contents.
class ScratchFolder {
public:
  /// Throws base::Error if the folder cannot be created.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// Runs the program words[0] with the arguments words[1], words[2], ... Returns the lines of its output,
/// except progress lines. If the program fails, throws base::Error with the program's message. If `progress`
/// is cancelled, stops the program and throws base::Cancelled. Thread-safe.
std::vector<std::string> run_child(const std::vector<std::string>& words, base::Progress& progress);

/// Creates a short report in a subfolder of `state` and opens the report in the browser. If `state` is empty,
/// uses the temporary folder. `program` is the path of `viete`. Returns a message. Throws like run_child().
std::string create_and_show_report(const std::filesystem::path& program, const std::filesystem::path& state,
                                   base::Progress& progress);

}  // namespace viete::app
