// Measures all figures of a report: the paper's figures and additional figures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/accuracy.h"
#include "bench/exp.h"
#include "bench/frame.h"
#include "bench/halfway.h"
#include "bench/modes.h"

namespace viete::bench {

struct ReportSizes {
  std::size_t matrices = 10'000'000;
  std::size_t samples = 16'384;  ///< number of matrices for each row of errors
  std::vector<std::size_t> faces = {50, 100, 300, 600};
  std::size_t rounds = 7;  ///< number of rounds for the frame times
};
/// Returns sizes that need a tenth of the time but give more noise.
ReportSizes quick_sizes();

struct ReportFiles {
  std::filesystem::path model, cage;
  std::vector<std::filesystem::path> poses;  ///< poses of the cage; if empty, one pose is generated
  std::filesystem::path rest;                ///< the model at rest for `shapes`
  std::vector<std::filesystem::path> shapes;
};

struct Figures {
  ReportSizes sizes;
  ReportFiles files;
  EigenBench eigen;
  ExpBench exp, exp_in_float;
  std::vector<AccuracyTable> accuracy, accuracy_in_float;
  std::vector<FrameTime> deformation;  ///< frames of the model in its cage
  std::vector<FrameTime> frames;       ///< frames in generated cages, for several numbers of triangles
  std::vector<NamedPose> poses;
  ModeComparison deformers;  ///< results of the named deformers
  Halfway shapes;
};

/// Measures the figures one by one. Throws base::Error and base::Cancelled.
Figures measure_figures(const ReportFiles& files, const ReportSizes& sizes, base::Progress& progress);

/// Returns all measurements in the JSON format of the benchmarks.
nlohmann::json to_json(const Figures& figures);

std::string shell_word(const std::filesystem::path& path);

}  // namespace viete::bench
