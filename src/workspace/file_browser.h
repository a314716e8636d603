// The state of the file browser for opening and saving; drawn by the file panel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "document/files_in_use.h"

namespace viete::workspace {

/// Options of morph targets, see AnimationExport.
struct MorphChoice {
  double tolerance = 1e-4;
  bool normals = true;

  friend bool operator==(const MorphChoice&, const MorphChoice&) = default;
};

/// Options of rendered pictures.
struct PictureChoice {
  bool cage = false, grid = true, light = false, panels = false;
  int width = 0, height = 0;  ///< logical pixels, least_picture to largest_picture
};
inline constexpr int least_picture = 16, largest_picture = 8192;

struct FileBrowser {
  enum class Purpose {
    model,
    cage,
    pose,
    poses,
    shapes,
    animation,
    locate_model,  ///< for a session
    locate_cage,
    save_session,
    save_pose,
    save_cage,
    save_model,
    save_animation
  };
  struct Entry {
    std::string name;
    bool folder = false;
    std::uintmax_t bytes = 0;
  };

  bool open = false;
  bool appearing = false;  ///< just opened: request the keyboard focus
  Purpose purpose = Purpose::model;
  std::filesystem::path folder;
  std::filesystem::file_time_type changed{};  ///< modification time of the folder when it was listed
  std::vector<Entry>
      entries;       ///< folders first, then files that fit the purpose, each sorted by name, ignoring case
  std::string path;  ///< content of the text field
  std::string problem;          ///< why the folder or file cannot be used, shown below the path; or empty
  std::filesystem::path asked;  ///< the file or folder being read or written for it; empty: none
  std::string suggested;        ///< proposed file name when saving; kept when the folder changes
  document::FilesInUse in_use;  ///< files that are neither proposed nor overwritten
  std::string filter;           ///< shows only entries that contain it, ignoring case
  std::string warned;  ///< the path for which overwriting was announced: a second Enter overwrites it
  /// Index among the shown entries: the one Enter uses. `none`: Enter saves under the typed name.
  std::size_t highlighted = 0;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  MorphChoice morphs;
  std::optional<PictureChoice> pictures;  ///< nullopt: as the window shows them

  bool saves() const { return purpose >= Purpose::save_session; }
  /// The formats of formats::all_formats() for the purpose, by extension: for poses those that preserve the
  /// vertex order; for animations also sequences, and pictures when saving.
  std::vector<std::string_view> formats() const;
  /// True if the text field names an animation of morph targets.
  bool makes_morphs() const;
  /// True if it names pictures.
  bool makes_pictures() const;
  /// True if the named file exists and is not in use, so that saving would overwrite it.
  bool replaces() const;
};

/// Opens the browser in a folder; if that is empty or missing, in the current one.
void show(FileBrowser& browser, FileBrowser::Purpose purpose, const std::filesystem::path& folder,
          const std::string& suggested = "", document::FilesInUse in_use = {});
/// Lists another folder; on failure stays in the current one and sets `problem`.
void enter(FileBrowser& browser, const std::filesystem::path& folder);

/// Lists the folder again if its content changed; keeps the text and the highlighted entry.
void refresh(FileBrowser& browser);

/// The entries that pass the filter, in order.
std::vector<const FileBrowser::Entry*> shown(const FileBrowser& browser);
/// Highlights a shown entry for Enter and the button. When saving, a file's name is copied to the text field;
/// a folder keeps it.
void highlight(FileBrowser& browser, std::size_t index);
/// Moves the highlight by `steps`, clamped to the list; when saving, keeps the name.
void move_highlight(FileBrowser& browser, int steps);

/// True if the filter starts a path, with / or ~, instead of a name.
bool filters_by_path(const FileBrowser& browser);

/// The typed path: relative to the folder; ~ is the home folder.
std::filesystem::path typed_path(const FileBrowser& browser);
/// typed_path() with the extension of the purpose if it has none.
std::filesystem::path chosen_file(const FileBrowser& browser);
/// Why that file cannot be opened or written; empty if it seems possible.
std::string problem_of_name(const FileBrowser& browser);
/// "OBJ, PLY or OFF".
std::string format_list(const FileBrowser& browser);
/// The extension of the file to be saved, in lower case: "ply".
std::string format_of(const FileBrowser& browser);
/// Shows why `asked` could not be read or written. Returns false if the browser did not request it.
bool refuse(FileBrowser& browser, const std::filesystem::path& asked, const std::string& problem);
/// Replaces the extension of the file name.
void set_format(FileBrowser& browser, const std::string& extension);

}  // namespace viete::workspace
