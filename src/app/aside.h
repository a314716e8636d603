// This program run once more, aside, for what takes long, so that the view stays live.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"

namespace viete::app {

/// words: the program and its arguments. Returns what it said, one line each, but for how far it was. Throws
/// base::Error with what it says where it fails, and base::Cancelled once it has ended. Thread-safe.
std::vector<std::string> run_aside(const std::vector<std::string>& words, base::Progress& progress);

/// It goes on by itself, however long the browser runs. Throws base::Error where there is none.
void open_in_browser(const std::filesystem::path& page);

/// A short report by `viete`, see `viete report`, in a folder of this one, which is then opened in the user's
/// browser; with an empty name, of that of temporary files. Returns what is to be said of it. Throws as
/// run_aside(). Thread-safe.
std::string show_report_aside(const std::filesystem::path& program, const std::filesystem::path& state,
                              base::Progress& progress);

}  // namespace viete::app
