// The figures of a report: the paper's three and ours, measured one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/accuracy.h"
#include "bench/eigen.h"
#include "bench/exp.h"
#include "bench/frame.h"
#include "bench/modes.h"

namespace viete::bench {

/// How much of each is measured.
struct ReportSizes {
  std::size_t matrices = 10'000'000;
  std::size_t samples = 16'384;  ///< matrices a row of errors
  std::vector<std::size_t> faces = {50, 100, 300, 600};
  std::size_t rounds = 7;  ///< of frames
};
/// A tenth of the time, and noisier.
ReportSizes quick_sizes();

struct ReportFiles {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;  ///< of the cage; empty: one that is made
  std::filesystem::path rest;                ///< a model at rest, and shapes of it: by default the dragon's
  std::vector<std::filesystem::path> shapes;
};

/// Dots of a model as it is seen, about 0, y up; lengths in diagonals of the model at rest.
struct ShapePicture {
  std::string name;
  std::vector<std::array<double, 2>> dots;
};

struct Figures {
  ReportSizes sizes;
  ReportFiles files;
  EigenBench eigen;
  ExpBench exp, exp_in_float;
  std::vector<AccuracyTable> accuracy, accuracy_in_float;
  std::vector<FrameTime> deformation;  ///< of the model in its cage
  std::vector<FrameTime> frames;       ///< in cages that are made, by number of triangles
  std::vector<NamedPose> poses;
  ModeComparison ways;                 ///< that have names
  nlohmann::json shapes;               ///< see measure_halfway()
  std::vector<ShapePicture> pictures;  ///< from rest to the shape that straight lines lose most volume to
};

/// One after the other, so that none disturbs another. Throws base::Error, base::Cancelled.
Figures measure_figures(const ReportFiles& files, const ReportSizes& sizes, base::Progress& progress);

/// All that was measured, as the benchmarks write it.
nlohmann::json to_json(const Figures& figures);

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
