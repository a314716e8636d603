// What sections say in numbers, each found in the figures in one way.
#pragma once

#include <span>
#include <string>

#include "bench/figures.h"

namespace viete::bench {

/// Triangles of the cage that frames are quoted of.
inline constexpr std::size_t usual_faces = 300;

/// How much less time than `than`: 76 of 0.24 and 1.
double percent_less(double time, double than);
/// "76 %", which no line parts.
std::string percent(double value);
/// Null where there is none; of one thread.
const FrameTime* frame_of(std::span<const FrameTime> times, const std::string& name, std::size_t faces);
/// The frame by links, with exp by that method.
const FrameTime* staged_frame(std::span<const FrameTime> times, sym3::Method method);
/// Over all gaps of two and of three eigenvalues; by the method of this label.
double worst_of_clusters(const std::vector<AccuracyTable>& tables, const std::string& method);
/// Of a way in a row of measure_halfway(): "27 %", "nothing".
std::string lost_volume(const nlohmann::json& way);
/// A path as a shell takes it.
std::string shell_word(const std::filesystem::path& path);

}  // namespace viete::bench
