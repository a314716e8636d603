// How many edits a person could take back.
#pragma once

#include "scene/history.h"

namespace viete::test {

inline std::size_t edit_count(scene::History history) {
  std::size_t count = 0;
  for (; history.can_undo(); ++count) history.undo({});
  return count;
}

}  // namespace viete::test
