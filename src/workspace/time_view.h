// State of the timeline panel: visible frames, selected keys, the running drag.
#pragma once

#include <optional>
#include <vector>

#include "document/document.h"

namespace viete::workspace {

/// The range of visible frames.
struct FrameWindow {
  static constexpr double least_length = 4;

  double first = 0, last = 64;
  double length() const { return last - first; }
  double frame_at(double share) const { return first + share * length(); }
  double share_of(double frame) const { return (frame - first) / length(); }

  friend bool operator==(const FrameWindow&, const FrameWindow&) = default;
};

using KeyPlaces = std::vector<document::KeyPlace>;

struct TimeView {
  enum class What { scrub, keys, box, pan };
  struct Drag {
    What what;
    double pressed;               ///< the frame at the press
    document::Timeline before{};  ///< for What::keys: the timeline at the press
    KeyPlaces keys{};             ///< for What::keys: the dragged keys
    bool moved = false;
    FrameWindow seen{};    ///< for What::pan: the visible frames at the press
    KeyPlaces selected{};  ///< for What::box: the selection at the press
  };
  FrameWindow seen;
  KeyPlaces selected;  ///< ascending
  std::optional<Drag> drag;
  bool hovered = false;  ///< the pointer is over the timeline
  bool fitted = false;   ///< `seen` fits the document's timeline
};

/// The range that shows the playback range and all keys, with a margin.
FrameWindow fitting(const document::Timeline& timeline);
/// Zooms about the frame at the fraction `share` of the width. A factor above 1 zooms out.
FrameWindow zoomed(const FrameWindow& seen, double share, double factor);
/// The number of frames between ruler lines, for about `lines` lines: 1, 2, 5, 10, 20 ...
int ruler_step(const FrameWindow& seen, double lines);

/// All keys, ascending. A pose key and a camera key of one frame have one place.
KeyPlaces key_places(const document::Timeline& timeline);
/// The frames of all keys, ascending.
std::vector<int> key_frames(const document::Timeline& timeline);
}  // namespace viete::workspace
