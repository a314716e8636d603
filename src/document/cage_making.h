// Generating a cage in the window: its settings, and the edit that applies the result.
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

/// While it is open, the document's cage follows the settings.
struct CageMaking {
  bool open = false;
  bool closing = false;  ///< confirmed, and waiting for the full-quality cage that replaces a preview
  CageWish wish;
  std::vector<std::string> notes{};              ///< about the last generated cage
  std::vector<std::string> lost{};               ///< poses and keys lost with the previous cage
  std::shared_ptr<const deform::Cage> made{};    ///< the last generated cage; not refined after its undo
  std::shared_ptr<const deform::Cage> before{};  ///< the document's cage when the panel was opened
};

/// True if the document's cage is the last generated one; the next one replaces it in the same edit.
bool shows_generated(const Document& document, const CageMaking& making);
/// As shows_generated(), and generating it was the last edit: replacing it loses nothing.
bool can_replace_generated(const Document& document, const CageMaking& making);

/// Puts a generated cage into the document, at rest. Undoable; cages generated one after the other without
/// another edit in between are one edit. Throws base::Error without a change if the cage is not valid.
void put_generated(Document& document, CageMaking& making, OpenedSurface surface,
                   std::shared_ptr<const deform::Cage> cage, std::vector<std::string> notes);

/// Undoes edits until the cage from before the panel was opened is back.
void cancel_making(Document& document, CageMaking& making);

/// A file next to the model that looks like its cage: cage.obj, MODEL_cage.obj and the like; empty if there
/// is none or if it is the model itself.
std::filesystem::path cage_beside(const std::filesystem::path& model);

}  // namespace viete::document
