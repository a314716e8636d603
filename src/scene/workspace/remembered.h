// What the program remembers from run to run: recent files, the last folder, that the first hints were seen,
// and how its window was arranged.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/workspace/keymap.h"
#include "scene/workspace/layout.h"

namespace viete::scene {

/// A session, or a model with its cage; absolute paths.
struct RecentFile {
  std::filesystem::path file, cage;  ///< cage may be empty

  friend bool operator==(const RecentFile&, const RecentFile&) = default;
};

struct Remembered {
  static constexpr std::size_t most = 12;

  std::vector<RecentFile> recent;  ///< newest first, each once, at most `most`
  std::filesystem::path folder;    ///< where a file was last chosen
  bool hints = true;               ///< the hints of the first start are still to be shown
  bool ask_keys = true;            ///< nobody has said yet which keys the hands know
  bool dark = true;                ///< the theme that was chosen last
  std::optional<bool>
      coarse_motion;  ///< as was chosen: what moves is drawn coarsely; nothing: where that helps
  std::optional<glm::ivec2> window;  ///< its size when it was used last, in logical pixels
  PanelLayout layout;
  Keymap keymap;

  /// To the front. Paths are made absolute.
  void add(const RecentFile& file);

  friend bool operator==(const Remembered&, const Remembered&) = default;
};

/// Throws base::Error if the file is there and cannot be understood; nothing is remembered if it is missing.
Remembered read_remembered(const std::filesystem::path& file);

/// Atomic. Recent files that another program has added since are kept, behind these. Throws base::Error.
void write_remembered(const std::filesystem::path& file, const Remembered& remembered);

}  // namespace viete::scene
