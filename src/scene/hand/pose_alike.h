// "Pose this end like that one": a part of a cage takes the pose of another one that is built alike.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "scene/document/document.h"
#include "scene/document/mirror.h"

namespace viete::scene {

/// A part of the cage in a pose.
struct PosedPart {
  std::span<const std::uint32_t> vertices;
  std::span<const mesh::Point> positions;  ///< theirs
  std::optional<std::uint32_t> active;     ///< one of them: the image of the other part's active one
};

/// Each vertex of `target` takes the place that its counterpart has in `part`: turned, mirrored and scaled as
/// the parts lie at rest, and relative to the joints, the vertices of the rest of the cage within two edges
/// of each part, as they are now. Counterparts are those of the mirror, which may be null, where it takes the
/// one part to the other, else those of match_parts(). Undoable. Returns why nothing was done, or "".
std::string pose_alike(Document& document, const PosedPart& part, std::span<const std::uint32_t> target,
                       std::optional<std::uint32_t> active, const Mirror* mirror);

}  // namespace viete::scene
