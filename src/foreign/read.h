// Reads a surface from a file of any format, also from foreign ones.
#pragma once

#include <filesystem>

#include "base/progress.h"
#include "formats/original.h"

namespace viete::foreign {

/// Works like formats::read(). If the format is foreign or the file is a compressed glTF file, runs the
/// program viete-import: $VIETE_IMPORT, the program beside this program, or the program in PATH. If it is not
/// installed, crashes, or takes more than `most_seconds`, throws base::Error. If `progress` is cancelled,
/// ends it.
formats::ReadResult read(const std::filesystem::path& path, base::Progress* progress = nullptr,
                         bool played = false, double most_seconds = 600);

}  // namespace viete::foreign
