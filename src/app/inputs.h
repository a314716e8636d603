// What a command opens, and how the model is to be moved: MODEL [CAGE] [--pose POSE], or a SESSION.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/output.h"
#include "scene/files/open.h"

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

/// MODEL, CAGE, --pose, --model and --cage of a session, --method, --way or --weights and
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

}  // namespace viete::app
