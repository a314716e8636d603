// Runs this program as a child process for long tasks, so that the view stays responsive.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::app {

/// words: the program and its arguments. Returns its output lines without progress reports. Throws
/// base::Error with its error message if it fails, and base::Cancelled after it has ended. Thread-safe.
std::vector<std::string> run_child(const std::vector<std::string>& words, base::Progress& progress);

/// Returns at once; the browser runs independently. Throws base::Error if there is none.
void open_in_browser(const std::filesystem::path& page);

/// Creates a short report with `viete report` in a new folder inside `state`, or the temporary folder if that
/// is empty, and opens it in the browser. Returns the message for the user. Throws like run_child().
/// Thread-safe.
std::string create_and_show_report(const std::filesystem::path& program, const std::filesystem::path& state,
                                   base::Progress& progress);

}  // namespace viete::app
