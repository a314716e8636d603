// The input and output files of a command.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/options.h"
#include "files/animation_export.h"
#include "files/export.h"
#include "files/open.h"
#include "files/shape_import.h"

namespace viete::app {

using files::check_output, files::Content, document::FilesInUse;

/// The output of a command.
struct Output {
  Content content = Content::surface;
  std::filesystem::path file{};
  formats::Digits digits{};
  bool split = false;  ///< see files::Export::split
  bool force = false;

  /// Text of the progress line, for example "Writing out.obj".
  std::string task() const { return "Writing " + file.filename().string(); }
};

/// The purpose for which a command opens its inputs.
enum class Use {
  window,     ///< MODEL is optional
  picture,    ///< needs a MODEL
  file,       ///< needs MODEL, CAGE and --pose
  animation,  ///< needs MODEL and CAGE, but no --pose
};

struct Inputs {
  Use use = Use::picture;
  std::filesystem::path model{}, cage{}, pose{};  ///< model may be a session
  document::RequestedSettings settings{};         ///< missing settings come from the session
  files::LocatedFiles located{};                  ///< files to use instead of the session's files

  bool session() const { return files::is_session(model); }
  files::OpenRequest request() const { return {files::OpenRequest::What::model, files(), settings, located}; }
  std::vector<std::filesystem::path> files() const { return {model, cage, pose}; }
};

/// Adds the options for `inputs.use`: files, the method, and the deformer with its settings. `inputs` must
/// outlive parsing.
void add_input_options(CLI::App& app, Inputs& inputs);

/// Adds the required option -o FILE and the option --force. Adds --digits unless the output is a picture.
CLI::Option* add_output_options(
    CLI::App& app, Output& output,
    const std::string& text = "Mesh file to write; the extension sets the format");

/// Adds --split.
void add_split_option(CLI::App& app, Output& output);

/// Call after parsing. Throws CLI::ParseError if an input is missing, or if an input cannot be combined with
/// a session. Throws base::Error if settings cannot be combined.
void check_usage(const Inputs& inputs);

/// Opens the inputs, then calls `check`. Throws base::Error on failure, or if a needed cage is missing.
files::Opened open(const Inputs& inputs, void (*check)(const files::Opened&));

/// Opens the inputs like open() above. Calls check_output() twice: before reading, and after reading with
/// the list of all files that were read. `also` is an additional input file.
files::Opened open(const Inputs& inputs, void (*check)(const files::Opened&), const Output& output,
                   const document::FileInUse& also = {});

/// The files named on the command line.
FilesInUse files_read(const Inputs& inputs);

void print_notes(const std::vector<std::string>& notes);
/// Prints one line to stdout: the output file and this summary.
void print_summary(const Output& output, const std::string& summary);

struct OpenedShapes {
  files::Opened model;                                      ///< always contains a document
  std::vector<std::vector<document::NamedShape>> of_files;  ///< the shapes of each file
};

/// Reads a model at rest and its shapes, see read_shapes(). Checks the output before reading, and again when
/// all input files are known. `frames`: the frame numbers of an animation; null for a single shape. Prints
/// notes. Throws base::Error.
OpenedShapes open_shapes(const std::filesystem::path& model, std::span<const std::filesystem::path> shapes,
                         const Output& output, const files::FrameSteps* frames = nullptr);

/// Returns an export of the document's deformed model to this output.
files::Export export_to(const Output& output, const files::Opened& opened);

/// Writes the frames. Prints notes and a summary. Returns the exit code.
int write_frames(const Output& output, const files::AnimationExport& what);

/// Writes the model with the shape `what.shape` and returns notes. Throws base::Error if the shape is too
/// large to draw or not finite. `name` is the subject of the error message, for example "the mix".
std::vector<std::string> write_shape(const files::Export& what, const std::string& name,
                                     base::Progress* progress);

/// Runs `write`. If Ctrl+C cancels `write`, throws base::Error with `advice`.
int run_cancellable(const Output& output, const std::function<int()>& write,
                    const char* advice = "no file was changed");

}  // namespace viete::app
