// The input and output files of a command.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "files/animation_export.h"
#include "files/export.h"
#include "files/open.h"
#include "files/output.h"
#include "files/shape_import.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace viete::app {

using files::check_output, files::Content, document::FilesInUse;

/// The output of a command.
struct Output {
  Content content = Content::surface;
  std::filesystem::path file{};
  formats::Digits digits{};
  bool force = false;

  /// For its progress: "Writing out.obj".
  std::string task() const { return "Writing " + file.filename().string(); }
};

/// The purpose for which a command opens its inputs.
enum class Use {
  window,     ///< MODEL is optional
  picture,    ///< needs a MODEL
  file,       ///< also needs CAGE and --pose
  animation,  ///< needs a CAGE; keys instead of a pose
};

struct Inputs {
  Use use = Use::picture;
  std::filesystem::path model{}, cage{}, pose{};  ///< model may be a session
  document::RequestedSettings settings{};         ///< unset ones come from the session
  files::LocatedFiles located{};                  ///< for a session

  bool session() const { return files::is_session(model); }
  files::OpenRequest request() const { return {files::OpenRequest::What::model, files(), settings, located}; }
  std::vector<std::filesystem::path> files() const { return {model, cage, pose}; }
};

/// Adds the options that the use of `inputs` needs: MODEL, CAGE, --pose, --model and --cage of a session,
/// --method, --deformer or --weights and --blend, --radius, --turn, --stretch, --stitched and its
/// constraints. The target must outlive parsing.
void add_input_options(CLI::App& app, Inputs& inputs);

/// Adds -o FILE, required, and --force; for meshes also --digits.
CLI::Option* add_output_options(
    CLI::App& app, Output& output,
    const std::string& text = "Mesh file to write; the extension sets the format");

/// Call after parsing. Throws CLI::ParseError if an input is missing or given in addition to a session that
/// names it, and base::Error for settings that cannot be combined.
void check_usage(const Inputs& inputs);

/// Throws base::Error if `check` does, or if the use needs a cage and there is none. Warnings are in the
/// result.
files::Opened open(const Inputs& inputs, void (*check)(const files::Opened&));

/// For a command with an output: also throws base::Error if check_output() does, before anything is read, and
/// again when all inputs are known. `also`: a further input.
files::Opened open(const Inputs& inputs, void (*check)(const files::Opened&), const Output& output,
                   const document::FileInUse& also = {});

/// The files named on the command line.
FilesInUse files_read(const Inputs& inputs);

/// Prints to stderr, one line each.
void print_notes(const std::vector<std::string>& notes);
/// Prints the summary of written frames to stdout, one line.
void print_summary(const Output& output, const std::string& summary);

struct OpenedShapes {
  files::Opened model;                                      ///< contains a document
  std::vector<std::vector<document::NamedShape>> of_files;  ///< one list per named file
};

/// Reads a model at rest and its shapes: see read_shapes(). Checks the output before reading, and again when
/// all inputs are known; `frames`: those of an animation's numbered files, or null. Prints notes. Throws
/// base::Error.
OpenedShapes open_shapes(const std::filesystem::path& model, std::span<const std::filesystem::path> shapes,
                         const Output& output, const files::FrameSteps* frames = nullptr);

/// The document's model and its deformation, for this output.
files::Export export_to(const Output& output, const files::Opened& opened);

/// Writes the frames; prints notes and a summary.
int write_frames(const Output& output, const files::AnimationExport& what);

/// Writes the model in its shape; errors call it by `name`: "the mix". Throws base::Error if the shape is too
/// large to draw or not finite. Returns notes.
std::vector<std::string> write_shape(const files::Export& what, const std::string& name,
                                     base::Progress* progress);

/// Runs `write`; converts a cancellation by Ctrl+C to an error with this advice.
int run_cancellable(const Output& output, const std::function<int()>& write,
                    const char* advice = "no file was changed");

}  // namespace viete::app
