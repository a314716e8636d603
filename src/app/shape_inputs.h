// What commands of shapes open: a model, and other files of it.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/output.h"
#include "deform/shape_space.h"
#include "scene/files/export.h"
#include "scene/files/open.h"
#include "scene/files/shape_import.h"

namespace viete::app {

struct OpenedShapes {
  scene::Opened model;                                   ///< with its document
  std::vector<std::vector<scene::NamedShape>> of_files;  ///< those of each file that was named
};

/// Reads a model, which is at rest, and its shapes: see read_shapes(). The output is checked before anything
/// is read, and again when all that is read is known; `frames` are those of an animation's numbered files, or
/// null. Notes are printed. Throws base::Error.
OpenedShapes open_shapes(const std::filesystem::path& model, std::span<const std::filesystem::path> shapes,
                         const Output& output, const scene::FrameSteps* frames = nullptr);

/// Writes the model in its shape, which errors call by the name: "the mix". Throws base::Error where that is
/// larger than can be drawn, or no numbers. Returns notes.
std::vector<std::string> write_shape(const scene::Export& what, const std::string& name,
                                     base::Progress* progress);

/// What a command of one file makes of Ctrl+C.
int unless_stopped(const std::filesystem::path& output, const std::function<int()>& write);

}  // namespace viete::app
