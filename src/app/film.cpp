#include "app/film.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/file_bytes.h"
#include "base/process.h"
#include "base/text.h"

namespace viete::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* advice = "install ffmpeg, or write numbered pictures: frame_####.png";
constexpr auto look_again = std::chrono::milliseconds(50);

// Returns the options of ffmpeg for the codec. All players support 4:2:0, which needs an even width and
// height.
std::vector<std::string> codec(const std::string& extension, FilmQuality quality) {
  const auto level = static_cast<std::size_t>(quality);
  const std::string even = "pad=ceil(iw/2)*2:ceil(ih/2)*2";
  if (extension == "gif") {
    constexpr std::array colors = {"64", "128", "256"};
    return {"-filter_complex",
            std::string("split[a][b];[a]palettegen=max_colors=") + colors[level] + "[p];[b][p]paletteuse"};
  }
  if (extension == "webm") {
    constexpr std::array factors = {"42", "33", "24"};
    return {"-vf", even, "-c:v", "libvpx-vp9", "-b:v", "0", "-crf", factors[level], "-pix_fmt", "yuv420p"};
  }
  constexpr std::array factors = {"30", "23", "17"};
  return {"-vf",          even,       "-c:v",    "libx264",   "-crf",
          factors[level], "-pix_fmt", "yuv420p", "-movflags", "+faststart"};
}

// The number of the last picture in ffmpeg's report, which has lines such as "frame=12".
double last_picture(const fs::path& report) {
  std::ifstream file(report);
  double last = 0;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("frame=")) last = std::strtod(line.c_str() + 6, nullptr);
  return last;
}

}  // namespace

std::span<const base::Choice> choices(FilmQuality) {
  static constexpr std::array<base::Choice, 3> all = {{{"low", "Low", "Small file"},
                                                       {"medium", "Medium", "Good for most uses"},
                                                       {"high", "High", "Hardly any loss"}}};
  return all;
}

void check_film_maker(const fs::path& film) {
  try {
    base::ChildProgram({"ffmpeg", "-version"}, advice).finish();
  } catch (const base::Error& error) {
    throw base::Error(film.string(),
                      "films need the program ffmpeg, which cannot be run (" + error.problem() + ")", advice);
  }
}

void make_film(const fs::path& film, const fs::path& folder, std::size_t pictures, double rate,
               FilmQuality quality, base::Progress& progress) {
  const std::string extension = base::extension_of(film);
  const fs::path made = folder / ("film." + extension), report = folder / "progress.txt";
  std::vector<std::string> words = {"ffmpeg",
                                    "-y",
                                    "-nostdin",
                                    "-v",
                                    "error",
                                    "-progress",
                                    "file:" + report.string(),
                                    "-framerate",
                                    base::formatted("%.9g", rate),
                                    "-i",
                                    (folder / "%06d.png").string()};
  for (const std::string& word : codec(extension, quality)) words.push_back(word);
  words.push_back(made.string());
  base::ChildProgram ffmpeg(words, advice);
  while (ffmpeg.running()) {
    std::this_thread::sleep_for(look_again);
    progress.report(last_picture(report) / static_cast<double>(pictures));  // if it throws, ffmpeg is killed
  }
  try {
    ffmpeg.finish();
  } catch (const base::Error& error) {
    throw base::Error(film.string(), "ffmpeg has failed: " + error.problem(),
                      "write numbered pictures: frame_####.png");
  }
  base::replace_file(film, [&](const base::ByteSink& sink) { sink(base::FileBytes(made).view()); });
}

}  // namespace viete::app
