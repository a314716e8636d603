// The timeline as it is looked at and held: which frames are seen, which keys are selected, what the mouse
// drags.
#pragma once

#include <optional>
#include <vector>

#include "scene/document/document.h"

namespace viete::scene {

/// The frames at its edges, which may lie between two.
struct FrameWindow {
  static constexpr double least_length = 4;

  double first = 0, last = 64;
  double length() const { return last - first; }
  double frame_at(double share) const { return first + share * length(); }
  double share_of(double frame) const { return (frame - first) / length(); }

  friend bool operator==(const FrameWindow&, const FrameWindow&) = default;
};

struct TimeView {
  enum class What { scrub, keys, box, pan };
  struct Drag {
    What what;
    double pressed;             ///< the frame that was pressed
    Timeline before{};          ///< What::keys: as it was then
    std::vector<int> frames{};  ///< and what is dragged
    bool moved = false;
    FrameWindow seen{};           ///< What::pan: as it was then
    std::vector<int> selected{};  ///< What::box: likewise
  };
  FrameWindow seen;
  std::vector<int> selected;  ///< frames of pose and camera keys, ascending
  std::optional<Drag> drag;
  bool hovered = false;  ///< the pointer is over it: Delete means keys
  bool fitted = false;   ///< `seen` was chosen for this document
};

/// All that plays and all keys, with a margin.
FrameWindow fitting(const Timeline& timeline);
/// About the frame at that share of the width; factor > 1 sees more.
FrameWindow zoomed(const FrameWindow& seen, double share, double factor);
/// Frames between lines of the ruler, so that there are about so many: 1, 2, 5, 10, 20 ...
int ruler_step(const FrameWindow& seen, double lines);

/// Frames that have a key of either kind, ascending.
std::vector<int> key_frames(const Timeline& timeline);
}  // namespace viete::scene
