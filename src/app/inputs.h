// The files that a command opens and writes.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "deform/shape_space.h"
#include "scene/files/export.h"
#include "scene/files/open.h"
#include "scene/files/output.h"
#include "scene/files/shape_import.h"

namespace viete::app {

using scene::check_output, scene::Content, scene::FilesInUse;

/// What a command writes.
struct Output {
  std::filesystem::path file;
  Content content;
  bool force = false;
};

}  // namespace viete::app

namespace CLI {
class App;
}

namespace viete::app {

/// What a command makes of what it opens.
enum class Use {
  window,     ///< MODEL may be left out
  picture,    ///< needs a MODEL
  file,       ///< needs CAGE and --pose too
  animation,  ///< needs a CAGE; keys in place of a pose
};

struct Inputs {
  Use use = Use::picture;
  std::filesystem::path model{}, cage{}, pose{};  ///< model may be a session
  scene::AskedSettings settings{};                ///< a session keeps what is left open as it has it
  scene::LocatedFiles located{};                  ///< for a session

  bool session() const { return scene::is_session(model); }
  scene::OpenRequest request() const { return {scene::OpenRequest::What::model, files(), settings, located}; }
  std::vector<std::filesystem::path> files() const { return {model, cage, pose}; }
};

/// MODEL, CAGE, --pose, --model and --cage of a session, --method, --deformer or --weights and
/// --blend, --radius, --turn and --stretch, --stitched and what holds a stitched mesh: those
/// that the use has. The target must outlive parsing.
void add_input_options(CLI::App& app, Inputs& inputs);

/// After parsing. Throws CLI::ParseError where something is missing, or is named beside a session that names
/// it too, and base::Error where the settings do not go together.
void check_usage(const Inputs& inputs);

/// Throws base::Error if `check` does, or if the inputs' use needs a cage and there is none. Warnings stay in
/// what is opened.
scene::Opened open(const Inputs& inputs, void (*check)(const scene::Opened&));

/// The same for a result: throws base::Error too where check_output() does, before anything is read, and
/// again when all that is read is known. `also`: is read besides.
scene::Opened open(const Inputs& inputs, void (*check)(const scene::Opened&), const Output& output,
                   const scene::FileInUse& also = {});

/// As they are named.
FilesInUse files_read(const Inputs& inputs);

/// On stderr, a line each.
void print_notes(const std::vector<std::string>& notes);
/// Of frames that were written, on stdout: a line.
void print_summary(const std::filesystem::path& file, const std::string& summary);

struct OpenedShapes {
  scene::Opened model;                                   ///< with its document
  std::vector<std::vector<scene::NamedShape>> of_files;  ///< those of each file that was named
};

/// Reads a model, which is at rest, and its shapes: see read_shapes(). The output is checked before anything
/// is read, and again when all that is read is known; `frames` are those of an animation's numbered files, or
/// null. Notes are printed. Throws base::Error.
OpenedShapes open_shapes(const std::filesystem::path& model, std::span<const std::filesystem::path> shapes,
                         const Output& output, const scene::FrameSteps* frames = nullptr);

/// Writes the model in its shape, which errors call by the name: "the mix". Throws base::Error where that is
/// larger than can be drawn, or no numbers. Returns notes.
std::vector<std::string> write_shape(const scene::Export& what, const std::string& name,
                                     base::Progress* progress);

/// What a command of one file makes of Ctrl+C.
int unless_stopped(const std::filesystem::path& output, const std::function<int()>& write);

}  // namespace viete::app
