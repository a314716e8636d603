// A vertex of a frame. Shared with vector code: no functions here (see sym3/fallback.h).
#pragma once

namespace viete::deform {

/// One vertex of a frame, as a graphics card takes it.
struct alignas(32) FrameVertex {
  float position[3];  ///< relative to the frame's origin
  float unused0;
  float normal[3];  ///< unit length; (0, 0, 1) where there is no area
  float unused1;
};

}  // namespace viete::deform
