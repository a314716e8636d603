// viete info [FILE...]: what a surface file holds.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/assets.h"
#include "app/command_line.h"
#include "base/error.h"
#include "mesh/facts.h"
#include "mesh/read.h"

namespace viete::app {

namespace {

void print(const std::filesystem::path& path, const mesh::ReadResult& read) {
  const mesh::Facts f = mesh::facts(read.surface);
  const mesh::Bounds box = mesh::used_bounds(read.surface);
  std::printf("%s\n", path.string().c_str());
  std::printf("  format      %s\n", read.format.c_str());
  std::printf("  vertices    %zu\n  polygons    %zu\n  triangles   %zu\n", f.vertices, f.polygons, f.triangles);
  std::printf("  parts       %zu\n", f.parts);
  std::printf("  surface     %s, %s, %s\n", f.closed() ? "closed" : "open", f.manifold() ? "manifold" : "not manifold",
              f.oriented() ? "consistently oriented" : "not consistently oriented");
  std::printf("  box         (%g, %g, %g) to (%g, %g, %g), diagonal %g\n", box.low[0], box.low[1], box.low[2], box.high[0],
              box.high[1], box.high[2], box.diagonal());
  std::printf("  area        %g\n", f.area);
  if (f.closed()) std::printf("  volume      %g\n", f.volume);
  const struct {
    const char* what;
    std::size_t count;
  } oddities[] = {{"boundary edges", f.boundary_edges.size()},
                  {"non-manifold edges", f.nonmanifold_edges.size()},
                  {"misoriented edges", f.misoriented_edges.size()},
                  {"unused vertices", f.unused_vertices.size()},
                  {"degenerate triangles", f.degenerate_triangles.size()}};
  for (const auto& oddity : oddities) {
    if (oddity.count > 0) std::printf("  %-20s %zu\n", oddity.what, oddity.count);
  }
  for (const auto& warning : read.warnings) std::printf("  note        %s\n", warning.c_str());
}

// Every file is looked at, also after one that cannot be read.
int info(const std::vector<std::filesystem::path>& files) {
  int code = exit_ok;
  for (const auto& file : files) {
    try {
      print(file, mesh::read(file));
    } catch (const base::Error& error) {
      std::fprintf(stderr, "viete: %s\n", error.what());
      code = exit_failed;
    }
  }
  return code;
}

}  // namespace

void add_info_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("info", "Say what surface files hold");
  auto files = std::make_shared<std::vector<std::filesystem::path>>();
  command->add_option("FILE", *files, "OBJ, PLY, OFF or STL files (default: the bundled model and its cage)");
  command->callback([files, &action] {
    action = [files] {
      if (!files->empty()) return info(*files);
      const auto [model, cage] = bundled_model();
      return info({model, cage});
    };
  });
}

}  // namespace viete::app
