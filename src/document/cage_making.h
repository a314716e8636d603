// The settings for generating a cage, and the edit that puts the generated cage into the document.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cages/wish.h"
#include "document/document.h"

namespace viete::document {

using cages::least_margin, cages::least_triangles, cages::most_cells, cages::most_gap, cages::most_margin;
using CageKind = cages::Kind;
using CageSymmetry = cages::Symmetry;
using CageWish = cages::Wish;

/// The state of the panel that generates cages. While the panel is open, the document's cage follows `wish`.
struct CageMaking {
  bool open = false;
  bool closing = false;  ///< true after confirmation, until the cage of full quality is ready
  CageWish wish;
  std::vector<std::string> notes{};            ///< messages about the last generated cage
  std::vector<std::string> lost{};             ///< messages about lost sets, poses and keys
  std::shared_ptr<const pose::Cage> made{};    ///< the last generated cage
  std::shared_ptr<const pose::Cage> before{};  ///< the document's cage when the panel was opened
};

/// True if the document has the last generated cage.
bool shows_generated(const Document& document, const CageMaking& making);
/// True if the document has the last generated cage, and the last edit generated it. In this case, replacing
/// the cage by another generated cage loses no work.
bool can_replace_generated(const Document& document, const CageMaking& making);

/// Puts the generated cage into the document, at rest. Undoable. Consecutive generated cages form one edit.
void put_generated(Document& document, CageMaking& making, OpenedSurface surface,
                   std::shared_ptr<const pose::Cage> cage, std::vector<std::string> notes);

/// Undoes edits until the document has the cage from before the panel was opened.
void cancel_making(Document& document, CageMaking& making);

/// Finds a file that may be the model's cage, such as cage.obj or MODEL_cage.obj in the model's folder. If no
/// such file exists, returns an empty path.
std::filesystem::path cage_beside(const std::filesystem::path& model);

}  // namespace viete::document
