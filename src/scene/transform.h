// Moving, turning and scaling the selected vertices about a pivot: exact where nothing or whole turns are
// asked for.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "scene/document.h"
#include "scene/tool.h"

namespace viete::scene {

struct Grip;

/// Scaled along axes, turned, then moved. Lengths in the file's units.
struct Transform {
  glm::dvec3 pivot{0, 0, 0};
  glm::dvec3 factors{1, 1, 1};
  glm::dmat3 axes{1};        ///< that the factors are along: columns of length 1, right-handed
  glm::dvec3 axis{0, 0, 1};  ///< of length 1
  double degrees = 0;  ///< right-handed, any number of turns; degrees, because 90 and 360 are exact in them
  glm::dvec3 shift{0, 0, 0};
  double amount = 0;  ///< of a grip that shapes without an angle

  /// Turn and scale as a matrix; multiples of 90 degrees about a file axis have entries 0, 1 and -1 only.
  glm::dmat3 linear() const;
};

/// A transform as it acts on points; whatever maps to itself keeps its bits.
class PointMotion {
public:
  explicit PointMotion(const Transform& transform);
  /// About this pivot, whatever the transform's is.
  mesh::Point operator()(const mesh::Point& p, const glm::dvec3& pivot) const;

private:
  glm::dmat3 linear_;
  glm::dvec3 shift_;
  bool turns_;
};

/// The largest turn that can be asked for at once: beyond a thousand turns angles lose digits.
inline constexpr double most_degrees = 360000;

/// The vertices of the cage that move with the selection; none of probes.
std::vector<std::uint32_t> moving_vertices(const Document& document);
/// True if a vertex or a probe is not where it was.
bool moved_since(const Document& document, const Snapshot& before);

/// The mean of the selected vertices or probes, in the file's units. Requires a selection.
glm::dvec3 selection_center(const Document& document);

/// Puts the vertices of the grip where the transform takes them from their place in `before`, about the
/// grip's pivots. If the turn differs from `degrees_seen`, the transform that the document shows, by more
/// than a mouse can turn in a frame, it is followed in small steps, so that the pose's whole turns are what a
/// slow turn would have made them. |degrees| is at most most_degrees. False, and the pose is as it was
/// before, if a vertex or the turns would leave their range (scene/range.h). Selected probes go along instead
/// where they are what is selected.
bool place(Document& document, const Snapshot& before, const Grip& grip, const Transform& transform,
           double degrees_seen);

/// After a turn has come to its end, from `before`: parts of the cage that turned as a whole have the whole
/// turns that they have made about its axis, in any pose, also where the logs of their elements cannot tell.
void keep_whole_turns(Document& document, const Snapshot& before, const Grip& grip,
                      const Transform& transform);

/// The whole edit at once, one entry of the history; nothing is recorded if nothing moves. Requires
/// a selection. False if it would leave the range of a pose: then nothing moves.
bool transform_selection(Document& document, Tool tool, const Grip& grip, const Transform& transform);

/// "rotate 3 faces".
std::string edit_label(Tool tool, const Selection& selection);

}  // namespace viete::scene
