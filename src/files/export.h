// Exports the deformed model, for the window and the command line.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "deform/exact.h"
#include "document/camera.h"
#include "document/document.h"
#include "formats/text_writer.h"

namespace viete::files {

/// A snapshot of the exported data: surfaces are shared and the pose is copied, so the document may change or
/// close while the file is written.
struct Export {
  std::filesystem::path file;
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const formats::Attributes> attributes;  ///< for the model; may be null
  std::shared_ptr<const formats::Original> original;      ///< for the model; may be null
  std::shared_ptr<const deform::Cage> cage;               ///< no_cage() if the model has no cage
  deform::Pose pose;
  deform::Scheme scheme;
  sym3::Method method;
  deform::Mask mask;
  deform::Probes probes;
  document::SharedShape shape;                ///< the model's shape; null: at rest
  document::UpAxis up = document::UpAxis::y;  ///< the model's up axis
  formats::Digits digits = {};
};

/// document.is_movable() must be true. Guesses the up axis from the model's file.
Export export_of(const document::Document& document, const std::filesystem::path& file);

/// Deforms the model in double and writes it in the format of the extension. Atomic: on any error an existing
/// file is unchanged. Creates its own thread pool. progress may be null. Returns messages about the result
/// for the user, one line each. Throws base::Error and base::Cancelled. Thread-safe.
std::vector<std::string> write_deformed(const Export& what, base::Progress* progress = nullptr);

/// The writing part of write_deformed(), for a model already deformed by deform_exactly() or an ExactDeformer
/// with the data in `what`.
std::vector<std::string> write_exact(const Export& what, deform::ExactModel deformed,
                                     base::Progress* progress = nullptr);

/// Cleans up exported positions: vertices that nothing moves, and coordinates changed only by rounding, take
/// their value in `shape`, the undeformed shape.
void keep_at_rest(const deform::Cage& cage, const deform::Pose& pose, const deform::Probes& probes,
                  const std::vector<mesh::Point>& shape, std::vector<mesh::Point>& positions);

/// A warning that other programs read glTF as metres with Y up, and the remedy; empty if that is correct.
std::string gltf_note(document::UpAxis up);

/// "5.8e-07": an upper bound in two digits, rounded up.
std::string at_most(double error);

/// A warning about the relative error of this method's exponentials, and the remedy; empty if it is
/// negligible.
std::string method_note(sym3::Method method, double worst_error);

}  // namespace viete::files
