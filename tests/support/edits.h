// Counts the edits that can be undone. Ignores changes of the selection.
#pragma once

#include "document/history.h"

namespace viete::test {

inline std::size_t edit_count(document::History history) {
  std::size_t count = 0;
  for (; history.can_undo(); history.undo({})) count += history.undo_label() != "select";
  return count;
}

}  // namespace viete::test
