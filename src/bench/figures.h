// Measures all figures of a report: the paper's figures and additional figures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "bench/exp.h"
#include "bench/frame.h"
#include "bench/modes.h"
#include "mesh/half_edges.h"
#include "mesh/surface.h"

namespace viete::bench {

struct ShapesOfModel {
  mesh::Surface rest;
  std::vector<std::string> names;
  std::vector<std::vector<mesh::Point>> shapes;
};

/// Reads the model at rest and its shapes. Throws base::Error.
ShapesOfModel read_shapes_of_model(const std::filesystem::path& rest,
                                   const std::vector<std::filesystem::path>& shapes);

/// Returns the root mean square of log(length in shape / geometric mean of lengths in a and b) over all
/// edges. Skips edges of length 0.
double edge_error(std::span<const mesh::Edge> edges, std::span<const mesh::Point> a,
                  std::span<const mesh::Point> b, std::span<const mesh::Point> shape);

/// Results halfway from rest to each shape, in log space and with linear interpolation.
struct Halfway {
  /// One row for each shape. "edges" is edge_error(). "volume" is relative to the smaller volume of rest and
  /// shape, or NaN if the model encloses no volume. "volumes" has the relative volumes at 21 even steps from
  /// rest to the shape.
  nlohmann::json rows;
  std::size_t most_lost = 0;  ///< row of the smallest volume halfway, with linear interpolation
};
/// Requires one shape or more. Throws base::Cancelled.
Halfway measure_halfway(const ShapesOfModel& model, base::Progress& progress);

/// Returns the shape's name: "coiled" for the file "shape_coiled.pc2".
std::string name_of_shape(const nlohmann::json& row);

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
