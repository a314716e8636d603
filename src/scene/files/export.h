// The deformed model as a file: the same from the window and from the command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/progress.h"
#include "deform/exact.h"
#include "mesh/formats/text_writer.h"
#include "scene/document/camera.h"
#include "scene/document/document.h"

namespace viete::scene {

/// All that the file is made of, as it is at one moment: surfaces are shared, the pose is a copy, so that the
/// document may change or go while the file is written.
struct Export {
  std::filesystem::path file;
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const mesh::Attributes> attributes;  ///< of the model; or null
  std::shared_ptr<const mesh::Original> original;      ///< of the model; or null
  std::shared_ptr<const deform::Cage> cage;            ///< or what stands for none, see Cage
  deform::Pose pose;
  deform::Scheme scheme;
  sym3::Method method;
  deform::Mask mask;
  deform::Probes probes;
  SharedShape shape;      ///< of the model; null: at rest
  UpAxis up = UpAxis::y;  ///< which of its axes is taken as up
  mesh::Digits digits = {};
};

/// Requires that something moves the model. Up is as guessed of its file.
Export export_of(const Document& document, const std::filesystem::path& file);

/// Deforms the model in double and writes it; the extension chooses the format. Atomic: whatever goes wrong,
/// an existing file is as it was. Uses a pool of its own for as long as it takes. progress may be null.
/// Returns what a person should know of the result, one line each. Throws base::Error and base::Cancelled.
/// Thread-safe.
std::vector<std::string> write_deformed(const Export& what, base::Progress* progress = nullptr);

/// The second half of it: the model deformed already, by deform_exactly() or an ExactDeformer, of all that is
/// in `what`.
std::vector<std::string> write_exact(const Export& what, deform::ExactModel deformed,
                                     base::Progress* progress = nullptr);

/// What files have of a deformed model: where nothing has moved it, or only rounding has moved a coordinate,
/// it is where the shape has it. `shape`: what the cage acts upon.
void keep_at_rest(const deform::Cage& cage, const deform::Pose& pose, const deform::Probes& probes,
                  const std::vector<mesh::Point>& shape, std::vector<mesh::Point>& positions);

/// That other programs will take a glTF's numbers as metres and Y as up, and what to do there; empty where
/// that is so.
std::string gltf_note(UpAxis up);

/// "5.8e-07": an upper bound in two digits, rounded up.
std::string at_most(double error);

/// That exponentials by this method were off by so much, relative, and what to do; empty where that is too
/// little to matter.
std::string method_note(sym3::Method method, double worst_error);

}  // namespace viete::scene
