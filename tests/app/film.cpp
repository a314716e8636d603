#include "app/film.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <thread>

#include "app/offscreen_viewer.h"
#include "base/error.h"
#include "base/os.h"
#include "files/output.h"
#include "render/image.h"
#include "support/folder.h"
#include "support/skip.h"

using namespace viete;
using namespace viete::test;
namespace fs = std::filesystem;

namespace {

/// Three pictures of odd size, and a folder for programs, which comes first in PATH.
struct Pictures : TemporaryFolder {
  const std::string path = std::getenv("PATH");
  const fs::path film = *this / "film.mp4";

  Pictures() {
    fs::create_directory(*this / "pictures");
    for (const char* name : {"000001.png", "000002.png", "000003.png"})
      render::write_png(*this / "pictures" / name, {33, 21, std::vector<std::uint8_t>(33 * 21 * 4, 200)});
  }
  ~Pictures() { set_environment("PATH", path); }

  /// Replaces ffmpeg by a shell script. The script gets the name of the film as $film.
  void fake_ffmpeg(const std::string& script) {
    fs::create_directory(*this / "programs");
    const fs::path program = *this / "programs" / "ffmpeg";
    put_file(program, "#!/bin/sh\nfor film; do :; done\n" + script);
    fs::permissions(program, fs::perms::owner_all);
    set_environment("PATH", (*this / "programs").string() + ":" + path);
  }
  void make(base::Progress& progress) const {
    app::make_film(film, *this / "pictures", 3, 24, app::FilmQuality::medium, progress);
  }
};

std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("films_are_recognised_by_their_extension") {
  for (const char* name : {"a.mp4", "b/c.WEBM", "x.gif"}) CHECK(files::is_film(name));
  for (const char* name : {"a.png", "mp4", "a.mp4.png", ""}) CHECK_FALSE(files::is_film(name));
}

TEST_CASE("a_missing_or_failing_ffmpeg_is_an_error_that_names_the_film") {
  Pictures p;
  put_file(p.film, "old");
  base::Progress progress;
  p.fake_ffmpeg("echo 'no such codec' >&2; exit 1\n");
  const std::string failed = error_of([&] { p.make(progress); });
  CHECK(failed.find("film.mp4") != std::string::npos);
  CHECK(failed.find("no such codec") != std::string::npos);
  set_environment("PATH", (p / "pictures").string());
  CHECK(error_of([&] { app::check_film_maker(p.film); }).find("films need the program ffmpeg") !=
        std::string::npos);
  CHECK(file_bytes(p.film) == "old");
}

TEST_CASE("a_film_replaces_an_older_one_and_a_cancelled_one_does_not") {
  Pictures p;
  put_file(p.film, "old");
  base::Progress progress;
  p.fake_ffmpeg("sleep 60\n");
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    progress.cancel();
  });
  CHECK_THROWS_AS(p.make(progress), base::Cancelled);
  CHECK(file_bytes(p.film) == "old");
  base::Progress again;
  p.fake_ffmpeg("printf 'of %s pictures' $(ls \"$(dirname \"$film\")\" | grep -c png) > \"$film\"\n");
  p.make(again);
  CHECK(file_bytes(p.film) == "of 3 pictures");
}

TEST_CASE("ffmpeg_makes_films_of_every_format_and_quality" * doctest::test_suite(if_present)) {
  Pictures p;
  try {
    app::check_film_maker("x.mp4");
  } catch (const base::Error&) {
    return skip("ffmpeg is not installed");
  }
  for (const std::string extension : {"mp4", "webm", "gif"})
    for (const auto quality : {app::FilmQuality::low, app::FilmQuality::medium, app::FilmQuality::high}) {
      base::Progress progress;
      const fs::path film = p / ("film." + extension);
      app::make_film(film, p / "pictures", 3, 23.976, quality, progress);
      CHECK(fs::file_size(film) > 100);
      files::check_output(film, files::Content::film, {}, files::Force::none);  // may be replaced by a film
      CHECK_THROWS_AS(files::check_output(film, files::Content::picture, {}, files::Force::none),
                      base::Error);
    }
}

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
