#include "mesh/write.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "mesh/obj.h"
#include "mesh/off.h"
#include "mesh/ply.h"
#include "mesh/source.h"
#include "mesh/stl.h"

namespace viete::mesh {

namespace {

using Format = std::string (*)(const Surface&, const std::vector<std::string>&);

Format format_for(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == "obj") return obj_bytes;
  if (extension == "ply") return ply_bytes;
  if (extension == "off") return off_bytes;
  if (extension == "stl") return stl_bytes;
  const std::string found = extension.empty() ? "no extension" : "unknown extension ." + extension;
  throw base::Error(path.string(), found, "use .obj, .ply, .off or .stl");
}

}  // namespace

void write(const std::filesystem::path& path, const Surface& surface,
           const std::vector<std::string>& comments) {
  base::replace_file(path, format_for(path)(surface, comments));
}

void check_format(const std::filesystem::path& path) {
  format_for(path);
}

}  // namespace viete::mesh
