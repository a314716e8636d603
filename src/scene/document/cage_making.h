// Making a cage in the window: what is wished for, and the edit that takes what was made.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cages/wish.h"
#include "scene/document/document.h"

namespace viete::scene {

using cages::all_kinds, cages::all_symmetries, cages::entry;
using cages::least_margin, cages::least_triangles, cages::most_cells, cages::most_gap, cages::most_margin;
using CageKind = cages::Kind;
using CageSymmetry = cages::Symmetry;
using CageWish = cages::Wish;

/// While it is open, the cage of the document follows the wish.
struct CageMaking {
  bool open = false;
  bool closing = false;  ///< done, but for the care that a preview was not made with
  CageWish wish;
  std::vector<std::string> notes{};              ///< on the cage that was made last
  std::vector<std::string> lost{};               ///< what went with the cage before these
  std::shared_ptr<const deform::Cage> made{};    ///< the last one; what an undo leads away from is left alone
  std::shared_ptr<const deform::Cage> before{};  ///< that of the document when it was opened
};

/// The document's cage is what was made last: another one replaces it in the same edit.
bool shows_made(const Document& document, const CageMaking& making);
/// And making it was the last edit: nothing is lost if another one takes its place.
bool goes_on(const Document& document, const CageMaking& making);

/// A made cage becomes that of the document, at rest. Undoable; those that are made one after the other,
/// with nothing in between, are one edit. Throws base::Error, and the document stays as it is, if it is no
/// cage.
void take_made(Document& document, CageMaking& making, OpenedSurface surface,
               std::shared_ptr<const deform::Cage> cage, std::vector<std::string> notes);

/// Takes everything back until the cage is the one from before it was opened.
void cancel_making(Document& document, CageMaking& making);

/// A file beside the model's that looks like its cage: cage.obj, MODEL_cage.obj and the like; empty if there
/// is none, or if it is the model.
std::filesystem::path cage_beside(const std::filesystem::path& model);

}  // namespace viete::scene
