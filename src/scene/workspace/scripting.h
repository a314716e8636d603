// What hands do is recorded, or a script moves them, see app/script.h.
#pragma once

#include <cstddef>
#include <string>

namespace viete::scene {

struct Scripting {
  bool recording = false;
  double recorded = 0;  ///< seconds of it so far

  bool playing = false;             ///< the cursor is the script's; nothing is written to files meanwhile
  bool waits = false;               ///< between two chapters, for a hand that goes on
  std::string title{}, text{};      ///< of the chapter; empty: there is none
  std::size_t chapter = 0, of = 0;  ///< from 1

  /// True while a script is shown, chapter by chapter.
  bool shown() const { return (playing || waits) && of > 0; }
};

/// What a person asks of it.
enum class ScriptRequest { none, record, tour, next, back, end };

}  // namespace viete::scene
