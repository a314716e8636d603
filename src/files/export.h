// Exports the deformed model.
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

/// A snapshot of the exported data. The document may change or close while the file is written.
struct Export {
  std::filesystem::path file;
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const formats::Attributes> attributes;  ///< of the model; may be null
  std::shared_ptr<const formats::Original> original;      ///< of the model; may be null
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

/// Guesses the up axis from the model's file. document.is_movable() must be true.
Export export_of(const document::Document& document, const std::filesystem::path& file);

/// Deforms the model in double and writes it in the format of the extension. On an error an existing file
/// stays. Creates its own thread pool. progress may be null. Returns messages for the user, one line each.
/// Throws base::Error and base::Cancelled. Thread-safe.
std::vector<std::string> write_deformed(const Export& what, base::Progress* progress = nullptr);

/// Writes a model that deform_exactly() or an ExactDeformer has deformed with the data in `what`.
std::vector<std::string> write_exact(const Export& what, deform::ExactModel deformed,
                                     base::Progress* progress = nullptr);

/// Sets coordinates that differ from `shape` only by rounding to their value in `shape`, the undeformed
/// positions. If neither cage nor probes are moved, sets all positions to `shape`.
void keep_at_rest(const deform::Cage& cage, const deform::Pose& pose, const deform::Probes& probes,
                  const std::vector<mesh::Point>& shape, std::vector<mesh::Point>& positions);

/// A warning with advice if the up axis is Z, because other programs read glTF with Y up; otherwise empty.
std::string gltf_note(document::UpAxis up);

/// The error rounded up to two digits: "5.8e-07".
std::string at_most(double error);

/// A warning with advice if the relative error of this method's exponentials exceeds 1e-9; otherwise empty.
std::string method_note(sym3::Method method, double worst_error);

}  // namespace viete::files
