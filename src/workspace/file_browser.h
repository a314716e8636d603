// The state of the file browser for opening and saving.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "document/files_in_use.h"

namespace viete::workspace {

/// Options of morph targets, see AnimationExport.
struct MorphChoice {
  double tolerance = 1e-4;
  bool normals = true;

  friend bool operator==(const MorphChoice&, const MorphChoice&) = default;
};

struct PictureChoice {
  bool cage = false, grid = true, light = false, panels = false;
  int width = 0, height = 0;  ///< in logical pixels, from least_picture to largest_picture
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
    locate_model,  ///< find the missing model of a session
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
  bool appearing = false;  ///< the browser was just opened and needs the keyboard focus
  Purpose purpose = Purpose::model;
  std::filesystem::path folder;
  std::filesystem::file_time_type changed{};  ///< modification time of the folder when it was listed
  std::vector<Entry> entries;   ///< folders, then files that fit the purpose; sorted by name, ignoring case
  std::string path;             ///< content of the text field
  std::string problem;          ///< why the folder or file cannot be used; empty: no problem
  std::filesystem::path asked;  ///< the file or folder that is being read or written; empty: none
  std::string suggested;        ///< proposed file name when saving; kept when the folder changes
  document::FilesInUse in_use;  ///< open files, which must not be overwritten
  bool saves_capture = false;   ///< the exported model is a capture
  std::string filter;           ///< only entries that contain this text are shown, ignoring case
  std::string filter_problem;   ///< why the path in `filter` cannot be opened; empty: no problem
  std::string warned;           ///< the existing file that is overwritten if the user presses Enter again
  /// Index of the shown entry that Enter opens. `none`: Enter saves under the typed name.
  std::size_t highlighted = 0;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  MorphChoice morphs;
  std::optional<PictureChoice> pictures;  ///< set when an animation is saved
  int first_frame = 1, last_frame = 0;    ///< the frames of the animation

  bool saves() const { return purpose >= Purpose::save_session; }
  /// The file extensions that fit the purpose.
  std::vector<std::string_view> formats() const;
  /// True if the text field contains the name of a glTF file for an animation.
  bool makes_morphs() const;
  /// True if the text field contains the name of PNG pictures for an animation.
  bool makes_pictures() const;
  /// The existing files that saving would overwrite, except files in use: the first file and the number.
  std::pair<std::filesystem::path, std::size_t> replaced() const;
  bool replaces() const { return replaced().second > 0; }
};

/// Opens the browser in `folder`, or in the current folder if `folder` is empty or missing.
void show(FileBrowser& browser, FileBrowser::Purpose purpose, const std::filesystem::path& folder,
          const std::string& suggested = "", document::FilesInUse in_use = {});
/// Lists another folder. If this fails, sets `problem` and keeps the folder.
void enter(FileBrowser& browser, const std::filesystem::path& folder);

/// Lists the folder again if its content changed; keeps the text and the highlighted entry.
void refresh(FileBrowser& browser);

/// The entries that pass the filter.
std::vector<const FileBrowser::Entry*> shown(const FileBrowser& browser);
/// Highlights a shown entry and copies its path to the text field, except the path of a folder when saving.
void highlight(FileBrowser& browser, std::size_t index);
/// Moves the highlight by `steps`, clamped to the list. When saving, keeps the text field.
void move_highlight(FileBrowser& browser, int steps);

/// True if the filter begins with / or ~. Then the filter is a path, not a part of a name.
bool filters_by_path(const FileBrowser& browser);

/// The path in the text field. A relative path is relative to the shown folder; ~ is the home folder.
std::filesystem::path typed_path(const FileBrowser& browser);
/// Like typed_path(). When saving, adds a missing extension, and "_####" if each frame gets its own file.
std::filesystem::path chosen_file(const FileBrowser& browser);
/// The reason why chosen_file() cannot be opened or written; empty if no reason is known.
std::string problem_of_name(const FileBrowser& browser);
/// The formats that fit the purpose: "OBJ, PLY or OFF".
std::string format_list(const FileBrowser& browser);
/// The extension of the file to be saved, in lower case: "ply".
std::string format_of(const FileBrowser& browser);
/// If the browser requested the file `asked`, opens the browser and shows `problem`. Otherwise returns false.
bool refuse(FileBrowser& browser, const std::filesystem::path& asked, const std::string& problem);
void set_format(FileBrowser& browser, const std::string& extension);

}  // namespace viete::workspace
