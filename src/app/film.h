// Films of numbered pictures, made by the program ffmpeg.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "base/choice.h"
#include "base/progress.h"

namespace viete::app {

enum class FilmQuality { low, medium, high };
std::span<const base::Choice> choices(FilmQuality);

/// If ffmpeg is not installed, throws base::Error with the name of the film.
void check_film_maker(const std::filesystem::path& film);

/// Makes a film of the pictures 000001.png, 000002.png, ... in the folder, and replaces an existing film
/// atomically. The extension decides the format, see files::film_formats. Writes another file to the folder.
/// Throws base::Error with the message of ffmpeg, and base::Cancelled.
void make_film(const std::filesystem::path& film, const std::filesystem::path& folder, std::size_t pictures,
               double rate, FilmQuality quality, base::Progress& progress);

}  // namespace viete::app
