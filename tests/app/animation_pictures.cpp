#include "app/animation_pictures.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "app/terminal_progress.h"

using namespace viete;

TEST_CASE("ffmpeg_is_told_what_comes_and_where_to") {
  for (const char* extension : {"mp4", "webm", "mkv", "gif"}) {
    CHECK(scene::is_video_format(extension));
    const auto words = app::ffmpeg_words(extension, 64, 48, 23.976, "/a b/-o.part");
    CHECK(words.front() == "ffmpeg");
    CHECK(words.back() == "file:/a b/-o.part");
    CHECK(std::ranges::find(words, "64x48") != words.end());
    CHECK(std::ranges::find(words, "23.976") != words.end());
  }
  CHECK_FALSE(scene::is_video_format("png"));
}

TEST_CASE("what_is_left_is_foreseen_once_something_is_known") {
  CHECK(app::progress_text(0, 10) == "0 %");
  CHECK(app::progress_text(0.5, 0.2) == "50 %");
  CHECK(app::progress_text(0.25, 10) == "25 %, 30 s left");
  CHECK(app::progress_text(0.1, 100) == "10 %, 15 min left");
}
