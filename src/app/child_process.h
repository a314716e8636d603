// Runs this program as a child process for long tasks, so that the view stays responsive.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::app {

/// Runs a program. words: its name and arguments. Returns its lines of output without progress. If the
/// program fails, throws base::Error with its message. If cancelled, waits for its end and throws
/// base::Cancelled. Thread-safe.
std::vector<std::string> run_child(const std::vector<std::string>& words, base::Progress& progress);

/// Opens the page in a browser and returns at once. Throws base::Error if no browser can be started.
void open_in_browser(const std::filesystem::path& page);

/// Creates a short report with `viete report` in the folder `state` (or the temporary folder if `state` is
/// empty) and opens it in the browser. Returns the message for the user. Throws like run_child().
/// Thread-safe.
std::string create_and_show_report(const std::filesystem::path& program, const std::filesystem::path& state,
                                   base::Progress& progress);

}  // namespace viete::app
