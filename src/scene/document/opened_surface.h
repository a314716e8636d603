// A surface of the document: of a file, or made here.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/formats/original.h"
#include "mesh/summary.h"
#include "mesh/surface.h"

namespace viete::scene {

/// A surface that was opened or made, and what was found in it.
struct OpenedSurface {
  std::filesystem::path path;  ///< empty: it is in no file as it is
  std::string format;
  std::shared_ptr<const mesh::Surface> surface;
  std::shared_ptr<const mesh::Attributes> attributes;  ///< null: none
  std::shared_ptr<const mesh::Original> original;      ///< null: it cannot be written again as it was
  mesh::Summary summary;
  mesh::Bounds bounds;  ///< of the vertices that a polygon uses
  std::vector<std::string> warnings;
  std::uint64_t content = 0;  ///< mesh::content_key(); 0: not known
  std::string made;           ///< of one that is in no file: what it is, "made here", "cage.obj, edited"
};

/// For people: of its file, or what was made.
inline std::string name_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.filename().string();
}

/// The same with the file's folder.
inline std::string place_of(const OpenedSurface& opened) {
  return opened.path.empty() ? opened.made : opened.path.string();
}

/// One that is in no file.
OpenedSurface made_surface(mesh::Surface surface, std::string made);

}  // namespace viete::scene
