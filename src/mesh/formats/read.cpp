#include "mesh/formats/read.h"

#include <algorithm>
#include <new>

#include "base/error.h"
#include "mesh/formats/foreign_content.h"
#include "mesh/formats/gltf.h"
#include "mesh/formats/gltf_file.h"
#include "mesh/formats/obj.h"
#include "mesh/formats/off.h"
#include "mesh/formats/ply.h"
#include "mesh/formats/stl.h"

namespace viete::mesh {

namespace {

// Control characters that no text has.
bool looks_binary(std::string_view bytes) {
  bytes = bytes.substr(0, 4096);
  return std::any_of(bytes.begin(), bytes.end(),
                     [](unsigned char c) { return c < 32 && (c < 8 || c > 13) && c != 26 && c != 27; });
}

[[noreturn]] void refuse_unknown(const Source& source) {
  throw base::Error(source.name, "the content is not OBJ, PLY, OFF, STL or glTF",
                    "export the model in one of these formats");
}

ReadResult by_extension(const Source& source) {
  refuse_foreign(source.name, source.bytes);
  if (source.extension == "glb" || source.extension == "gltf") return read_gltf(source);
  if (source.extension == "stl") return read_stl(source);
  if (looks_binary(source.bytes)) refuse_unknown(source);
  if (source.extension == "ply" && !looks_like_obj(source)) return read_ply(source);
  if (source.extension == "off" && !looks_like_obj(source)) return read_off(source);
  if (source.extension == "obj" || looks_like_obj(source)) return read_obj(source);
  refuse_unknown(source);
}

}  // namespace

ReadResult read(const Source& source) {
  try {
    if (looks_like_ply(source)) return read_ply(source);
    if (looks_like_gltf(source)) return read_gltf(source);
    if (looks_like_stl(source)) return read_stl(source);
    if (looks_like_off(source)) return read_off(source);
    return by_extension(source);
  } catch (const std::bad_alloc&) {
    throw base::Error(source.name, "the model does not fit into memory", "reduce it or use a larger machine");
  }
}

ReadResult read(const std::filesystem::path& path, base::Progress* progress, bool played) {
  const auto bytes = std::make_shared<const FileBytes>(path, progress);
  const auto folder = std::filesystem::absolute(path).parent_path();
  return read(Source{path.string(), extension_of(path), bytes->view(), progress, bytes, folder, played});
}

}  // namespace viete::mesh
