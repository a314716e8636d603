// What a report measures: the paper's three figures and five of ours, in one go.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/accuracy.h"
#include "bench/eigen.h"
#include "bench/exp.h"
#include "bench/frame_bars.h"
#include "bench/mode_comparison.h"

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

}  // namespace viete::bench
