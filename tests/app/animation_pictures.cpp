#include "app/offscreen_viewer.h"

#include <doctest/doctest.h>

#include "app/command_line.h"

using namespace viete;

TEST_CASE("the_command_for_a_film_has_the_rate_and_the_names_of_the_pictures") {
  app::PictureRun run{"/a b/it's 5%_####.png", {3, 4, 5}, 23.976};
  const std::string even = " -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2' -pix_fmt yuv420p ";
  CHECK(app::ffmpeg_command(run) ==
        "ffmpeg -framerate 23.976 -start_number 3 -i '/a b/it'\\''s 5%%_%04d.png'" + even +
            "'/a b/it'\\''s 5%.mp4'");
  run = {"/##.png", {3, 4}, 24};
  CHECK(app::ffmpeg_command(run) ==
        "ffmpeg -framerate 24 -start_number 3 -i '/%02d.png'" + even + "'/film.mp4'");
}

TEST_CASE("the_remaining_time_is_estimated_once_there_is_data") {
  CHECK(app::progress_text(0, 10) == "0 %");
  CHECK(app::progress_text(0.5, 0.2) == "50 %");
  CHECK(app::progress_text(0.25, 10) == "25 %, 30 s left");
  CHECK(app::progress_text(0.1, 100) == "10 %, 15 min left");
}
