// viete info [FILE...] [--cage CAGE]: prints the contents and defects of surface files.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/assets.h"
#include "app/command_line.h"
#include "app/options.h"
#include "base/error.h"
#include "base/text.h"
#include "document/checks.h"
#include "document/elements.h"
#include "foreign/read.h"

namespace viete::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t named = 12;  // elements listed per finding

// Prints as many digits as needed for six significant digits of the box's size.
std::string box_text(const mesh::Bounds& box) {
  const double farthest = std::max(mesh::largest_abs(box.low), mesh::largest_abs(box.high)),
               size = box.diagonal();
  const double more = farthest > size && size > 0 ? std::ceil(std::log10(farthest / size)) : 0;
  const int digits = std::min(17, 6 + static_cast<int>(more));
  const auto text = [digits](const mesh::Point& p) {
    return base::formatted("(%.*g, %.*g, %.*g)", digits, p[0], digits, p[1], digits, p[2]);
  };
  return text(box.low) + " to " + text(box.high) + base::formatted(", diagonal %g", size);
}

void print(const mesh::Splats& splats) {
  std::size_t faint = 0;
  for (std::size_t i = 0; i < splats.size(); ++i) faint += splats.is_faint(i) ? 1 : 0;
  std::printf("  splats      %zu, harmonics of degree %d\n", splats.size(), splats.degree);
  std::printf("  opacity     below 0.05 in %.3g %% of the splats\n",
              100 * static_cast<double>(faint) / static_cast<double>(splats.size()));
  std::printf("  up          -y in most captures\n");
}

void print_faces(const document::OpenedSurface& surface) {
  const mesh::Summary& f = surface.summary;
  std::printf("  polygons    %zu\n  triangles   %zu\n  parts       %zu\n", f.polygons, f.triangles, f.parts);
  std::printf("  surface     %s, %s, %s\n", f.closed() ? "closed" : "open",
              f.manifold() ? "manifold" : "not manifold",
              f.oriented() ? "consistently oriented" : "not consistently oriented");
  if (const auto topology = mesh::topology(*surface.surface, f)) {
    std::printf("  topology    genus %zu, %s\n", topology->genus,
                topology->holes == 0 ? "no holes" : base::counted(topology->holes, "hole").c_str());
  }
  std::printf("  area        %g\n", f.area);
  const double rounding = 1e-14 * std::pow(surface.bounds.diagonal(), 3);
  if (f.closed()) std::printf("  volume      %g\n", std::abs(f.volume) < rounding ? 0 : f.volume);
}

void print(const document::OpenedSurface& surface) {
  std::printf("%s\n", surface.path.string().c_str());
  std::printf("  format      %s\n  vertices    %zu\n", surface.format.c_str(), surface.summary.vertices);
  if (surface.summary.polygons > 0) print_faces(surface);
  std::printf("  box         %s\n", box_text(surface.bounds).c_str());
  if (surface.splats) print(*surface.splats);
  for (const auto& warning : surface.warnings) std::printf("  note        %s\n", warning.c_str());
  const auto document = document::Document(surface);
  using Check = void (*)(const document::Document&);
  for (const auto check :
       std::initializer_list<Check>{document::check_drawable, document::check_deformable}) {
    try {
      check(document);
    } catch (const base::Error& error) {
      std::printf("  note        %s; %s\n", error.problem().c_str(), error.advice().c_str());
    }
  }
}

// If the deform command cannot use the cage, prints the reason.
void print_refusal(const document::OpenedSurface& cage) {
  document::Document document;
  try {
    document::set_cage(document, cage);
  } catch (const base::Error& error) {
    std::printf("  finding     %s; %s\n", error.problem().c_str(), error.advice().c_str());
  }
}

void print(const std::vector<document::Finding>& findings) {
  if (findings.empty()) std::printf("  findings    none\n");
  for (const auto& finding : findings) {
    const bool cage = finding.subject == document::Subject::cage;
    std::printf("  %s%s%s\n", document::matters(finding) ? "finding     " : "note        ",
                cage ? "cage: " : "", document::title(finding).c_str());
    std::printf("              %s\n", document::meaning(finding).c_str());
    std::printf("              %s %s\n", document::element_name(finding.kind).c_str(),
                document::first_elements(finding, named).c_str());
  }
}

// After an error, continues with the next file.
int info(const std::vector<fs::path>& files, const fs::path& cage_file) {
  document::OpenedSurface cage;
  if (!cage_file.empty()) {
    cage = document::open_surface(cage_file);
    print(cage);
    print_refusal(cage);
  }
  int code = exit_ok;
  for (const auto& file : files) {
    try {
      const document::OpenedSurface model = document::open_surface(file);
      print(model);
      print(document::check(model, cage));
    } catch (const base::Error& error) {
      std::fprintf(stderr, "viete: %s\n", error.what());
      code = exit_failed;
    }
  }
  return code;
}

}  // namespace

void add_info_command(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("info", "Show the properties and defects of meshes");
  auto files = std::make_shared<std::vector<fs::path>>();
  auto cage = std::make_shared<fs::path>();
  command->add_option("FILE", *files, foreign::model_formats() + " files (default: the bundled dragon)");
  add_file_option(*command, "--cage", *cage, "Cage to check together with the meshes");
  add_examples(*command, {"info model.obj", "info model.obj --cage cage.obj"});
  command->callback([files, cage, &action] {
    action = [files, cage] {
      if (!files->empty()) return info(*files, *cage);
      const auto bundled = bundled_model();
      return info({bundled.model}, bundled.cage);
    };
  });
}

}  // namespace viete::app
