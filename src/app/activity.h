// An activity: a part of the frame that reacts to changes of its input.
#pragma once

#include <algorithm>
#include <functional>
#include <span>

#include "base/clock.h"

namespace viete::app {

struct Activity {
  const char* name;
  /// Returns the seconds until step() has something to do: 0 means now, base::never means only after input or
  /// after another activity.
  std::function<double()> due_in;
  /// Reacts to all changes since the last step. Returns true if panels must be drawn until their sizes
  /// settle.
  std::function<bool()> step;
};

/// Converts a condition to a result of Activity::due_in.
inline double now_if(bool due) {
  return due ? 0 : base::never;
}

/// Returns the seconds until the first of the activities is due.
inline double due_in(std::span<const Activity> activities) {
  double first = base::never;
  for (const Activity& activity : activities) first = std::min(first, activity.due_in());
  return first;
}

}  // namespace viete::app
