// viete deform MODEL CAGE --pose POSE -o OUT, or viete deform SESSION -o OUT: the deformed mesh as a file.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/command_line.h"
#include "app/options.h"
#include "app/output.h"
#include "base/error.h"
#include "scene/export.h"
#include "scene/open.h"

namespace viete::app {

namespace {

struct DeformOptions {
  std::filesystem::path model, cage, pose, output;
  sym3::Method method = sym3::Method::fast;
  SchemeOptions scheme;
  bool method_given = false, force = false;
};

void warn(const std::vector<std::string>& warnings) {
  for (const auto& warning : warnings) std::fprintf(stderr, "viete: note: %s\n", warning.c_str());
}

// A session's own settings hold unless others are given.
scene::Document open(const DeformOptions& options) {
  scene::Opened opened =
      scene::open_files({scene::OpenRequest::What::model, {options.model, options.cage, options.pose}}, {});
  scene::check_deformable(opened);
  warn(opened.warnings);
  scene::Document document = *std::move(opened.document);
  if (!document.has_cage())
    throw base::Error(options.model.string(), "the session has no cage", "open it and add one");
  if (!opened.session || options.method_given) document.method = options.method;
  options.scheme.apply(document, opened.session.has_value());
  return document;
}

int deform_file(const DeformOptions& options) {
  check_output(options.output, Content::surface,
               with_files_of_sessions({options.model, options.cage, options.pose}), options.force);
  warn(scene::write_deformed(scene::export_of(open(options), options.output)));
  return exit_ok;
}

}  // namespace

void add_deform_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("deform", "Deform a mesh by a posed cage and write it");
  auto o = std::make_shared<DeformOptions>();
  add_file_option(*command, "MODEL", o->model,
                  "Mesh (OBJ, PLY, OFF, STL), or a session (.viete) with its cage and pose")
      ->required();
  add_file_option(*command, "CAGE", o->cage, "Cage around it, at rest");
  add_file_option(*command, "--pose", o->pose, "Posed version of the cage, same vertices in the same order");
  add_file_option(*command, "-o,--output", o->output, "File to write; the extension chooses the format")
      ->required();
  add_force_option(*command, o->force);
  add_method_option(*command, o->method);
  add_scheme_options(*command, o->scheme);
  command->callback([o, command, &action] {
    check_session_stands_alone(o->model, o->cage, o->pose);
    const bool session = scene::is_session(o->model);
    if (!session && o->cage.empty()) throw CLI::RequiredError("CAGE");
    if (!session && o->pose.empty()) throw CLI::RequiredError("--pose");
    o->method_given = command->count("--method") > 0;
    action = [o] { return deform_file(*o); };
  });
}

}  // namespace viete::app
