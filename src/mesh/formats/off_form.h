// What forms of OFF have in common.
#pragma once

#include <cstddef>

#include "mesh/formats/text_cursor.h"

namespace viete::mesh {

inline constexpr TextRules off_rules{.comment = '#'};

/// What the rows of vertices hold behind positions, and where.
struct OffForm {
  bool normals = false, colors = false, texture = false;
  bool more_axes = false;     ///< 4OFF, nOFF
  bool colors_first = false;  ///< of four numbers before the normals, as MeshLab writes them
  bool wrapped = false;       ///< rows end with their last number, not with the line

  std::size_t numbers() const { return (normals ? 3U : 0U) + (colors ? 4U : 0U) + (texture ? 2U : 0U); }
};

}  // namespace viete::mesh
