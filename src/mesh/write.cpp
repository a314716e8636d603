#include "mesh/write.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/gltf_output.h"
#include "mesh/obj.h"
#include "mesh/off.h"
#include "mesh/ply.h"
#include "mesh/source.h"
#include "mesh/stl.h"

namespace viete::mesh {

namespace {

using Format = void (*)(const Content&, TextWriter&);

Format format_for(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == "obj") return write_obj;
  if (extension == "ply") return write_ply;
  if (extension == "off") return write_off;
  if (extension == "stl") return write_stl;
  if (extension == "glb") return write_glb;
  if (extension == "gltf") return write_gltf;
  const std::string found = extension.empty() ? "no extension" : "unknown extension ." + extension;
  throw base::Error(path.string(), found, "use .obj, .ply, .off, .stl, .glb or .gltf");
}

}  // namespace

void write(const std::filesystem::path& path, const Surface& surface,
           const std::vector<std::string>& comments) {
  write(path, surface, surface.positions, comments);
}

void write(const std::filesystem::path& path, const Surface& surface, std::span<const Point> positions,
           const std::vector<std::string>& comments, base::Progress* progress) {
  write(path, Content{surface, positions, comments}, nullptr, {}, progress);
}

std::vector<std::string> write(const std::filesystem::path& path, const Content& content,
                               const Original* original, Digits digits, base::Progress* progress) {
  if (original && original->writes(extension_of(path)))
    return original->write_file(path, content.surface, content.positions, digits, progress);
  const Format format = format_for(path);
  base::replace_file(path, [&](const base::ByteSink& sink) {
    TextWriter out(sink, progress, digits);
    format(content, out);
    out.finish();
  });
  return {};
}

void check_format(const std::filesystem::path& path) {
  format_for(path);
}

}  // namespace viete::mesh
