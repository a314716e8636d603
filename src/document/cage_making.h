// The settings for generating a cage in the window, and the edit that applies the generated cage.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cages/wish.h"
#include "document/document.h"

namespace viete::document {

using cages::all_kinds, cages::all_symmetries;
using cages::least_margin, cages::least_triangles, cages::most_cells, cages::most_gap, cages::most_margin;
using CageKind = cages::Kind;
using CageSymmetry = cages::Symmetry;
using CageWish = cages::Wish;

/// While the panel is open, the document's cage follows the settings.
struct CageMaking {
  bool open = false;
  bool closing = false;  ///< the user confirmed, but a full-quality cage must still replace the preview
  CageWish wish;
  std::vector<std::string> notes{};              ///< messages about the last generated cage
  std::vector<std::string> lost{};               ///< messages about sets, poses and keys of the previous cage
  std::shared_ptr<const deform::Cage> made{};    ///< the last generated cage
  std::shared_ptr<const deform::Cage> before{};  ///< the document's cage when the panel was opened
};

/// True if the document's cage is the last generated cage.
bool shows_generated(const Document& document, const CageMaking& making);
/// True if the document's cage is the last generated cage and the last edit generated it. Then replacing the
/// cage loses no work.
bool can_replace_generated(const Document& document, const CageMaking& making);

/// Puts a generated cage at rest into the document. Undoable. Consecutive generated cages form one edit.
void put_generated(Document& document, CageMaking& making, OpenedSurface surface,
                   std::shared_ptr<const deform::Cage> cage, std::vector<std::string> notes);

/// Undoes edits until the document has the cage from before the panel was opened.
void cancel_making(Document& document, CageMaking& making);

/// Returns a file in the model's folder whose name suggests a cage, such as cage.obj or MODEL_cage.obj; an
/// empty path if no such file exists.
std::filesystem::path cage_beside(const std::filesystem::path& model);

}  // namespace viete::document
