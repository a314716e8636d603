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

/// A copy of the data to export. While the file is written, the document may change or close.
struct Export {
  std::filesystem::path file;
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const formats::Attributes> attributes;  ///< attributes of the model; may be null
  std::shared_ptr<const formats::Original> original;      ///< original of the model; may be null
  std::shared_ptr<const pose::Cage> cage;                 ///< no_cage() if the model has no cage
  pose::Pose pose;
  pose::Deformer deformer;
  sym3::Method method;
  weights::Mask mask;
  pose::Probes probes;
  document::SharedShape shape;                ///< the model's shape; if null, the model is at rest
  document::UpAxis up = document::UpAxis::y;  ///< the model's up axis
  formats::Digits digits = {};
  std::shared_ptr<const mesh::Splats> splats = nullptr;  ///< of a capture; null for other models
  bool split = false;                                    ///< true: see deform::split_stretched()
};

/// Copies the data. Guesses the up axis from the model's file. document.is_movable() must be true.
Export export_of(const document::Document& document, const std::filesystem::path& file);

/// Deforms the model in double precision and writes the file. The extension selects the format. If an error
/// occurs, an existing file is not changed. Creates a thread pool. progress may be null. Returns messages for
/// the user, one line each. Throws base::Error and base::Cancelled. Thread-safe.
std::vector<std::string> write_deformed(const Export& what, base::Progress* progress = nullptr);

/// Writes `deformed`, the result of deform_exactly() or ExactDeformer for `what`. Returns messages.
std::vector<std::string> write_exact(const Export& what, deform::ExactModel deformed,
                                     base::Progress* progress = nullptr);

/// `shape`: the undeformed positions. If a coordinate in `positions` differs from `shape` only by rounding,
/// sets the coordinate to the value in `shape`. If cage and probes are at rest, sets `positions` to `shape`.
void keep_at_rest(const pose::Cage& cage, const pose::Pose& pose, const pose::Probes& probes,
                  const std::vector<mesh::Point>& shape, std::vector<mesh::Point>& positions);

/// If the up axis is Z, returns a warning, because other programs read glTF with Y up.
std::vector<std::string> gltf_notes(document::UpAxis up);

/// Returns the error, rounded up to two digits: "5.8e-07".
std::string at_most(double error);

/// worst_error: relative error of exponentials. If the error exceeds 1e-9, returns a warning.
std::vector<std::string> method_notes(sym3::Method method, double worst_error);

}  // namespace viete::files
