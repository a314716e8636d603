// What the deformer had to decide in a pose, in words.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "deform/maps.h"

namespace viete::scene {

/// One line per kind of trouble, with how often and the first place; nothing for a pose without trouble. A
/// closed cage that is turned inside out, as by a mirror, is told from one that is only torn.
std::vector<std::string> pose_notes(const deform::LogReport& report, const deform::Cage& cage,
                                    const deform::Pose& pose);

/// The vertices at both ends of the cage's edges between torn neighbours, at most so many; nothing where
/// elements are neither triangles nor vertices.
std::vector<std::array<std::uint32_t, 2>> torn_edges(const deform::LogReport& report,
                                                     const deform::Cage& cage, std::size_t most);

}  // namespace viete::scene
