// Converts and checks the arguments of deform.h. Runs long work with a Watch.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/background.h"
#include "base/choice.h"
#include "base/error.h"
#include "base/progress.h"
#include "base/text.h"
#include "library/deform.h"
#include "mesh/surface.h"
#include "pose/deformer.h"
#include "sym3/exp.h"

namespace viete::library {

std::vector<mesh::Point> inside(std::span<const Point3> points);
std::vector<Point3> outside(std::span<const mesh::Point> points);

/// Throws base::Error if an index is invalid, a face has fewer than three corners, or a coordinate is above
/// largest_coordinate or not finite. The error message begins with `what`, for example "the model".
mesh::Surface surface_of(const Mesh& mesh, const char* what);
/// Points with larger coordinates cannot be deformed.
inline constexpr double most_deformable = 1e60;
/// Like surface_of(). Also throws if a coordinate is above most_deformable, or if the size is above 0 and
/// below 1e-60.
mesh::Surface deformable_surface_of(const Mesh& mesh, const char* what);
Mesh mesh_of(const mesh::Surface& surface);

/// Returns the points. Throws base::Error if their number is not `vertices`, or a coordinate is too large.
std::vector<mesh::Point> deformable(std::vector<mesh::Point> points, std::size_t vertices, const char* what);
/// Works like deformable(), but reads three numbers for each vertex.
std::vector<mesh::Point> deformable_points(std::span<const double> numbers, std::size_t vertices,
                                           const char* what);
/// If a coordinate of a result is not finite, throws base::Error with `what` and `advice`.
void check_finite(std::span<const mesh::Point> points, const char* what, const char* advice);

inline std::string plain(double value) {
  return base::formatted("%.6g", value);
}

/// Returns the value with this name. If the name is not valid, throws base::Error with all names.
template <class Value>
Value named(const std::string& name, const char* what) {
  if (const auto value = base::value_of_word<Value>(name)) return *value;
  std::string names;
  for (const base::Choice& choice : choices(Value{}))
    names += (names.empty() ? "" : ", ") + std::string(choice.word);
  throw base::Error(what, "unknown name " + name, "choose one of " + names);
}

inline void check_range(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw base::Error(what, plain(value) + " is out of range", "choose " + plain(low) + " to " + plain(high));
}

template <class Impl, class... Arguments>
Hidden<Impl> hidden(Arguments&&... arguments) {
  return {new Impl(std::forward<Arguments>(arguments)...), [](Impl* impl) { delete impl; }};
}

/// Return the settings. For unknown names and numbers out of range, throw base::Error.
pose::Deformer deformer_of(const Blending& blending);
sym3::Method method_of(const std::string& name);

/// Returns a description of the members of Blending, for docstrings: "\nway: ...\n  'smooth': ...".
std::string settings_text();

inline int checked_threads(int threads) {
  check_range("threads", threads, 0, 1024);
  return threads;
}

/// Runs work(&progress) in another thread, and meanwhile calls watch(). If `watch` is empty, runs
/// work(nullptr) in this thread.
template <class Work>
auto watched(const Watch& watch, const Work& work) {
  if (!watch) return work(static_cast<base::Progress*>(nullptr));
  base::Progress progress;
  base::BackgroundQueue queue;
  auto result = queue.add([&] { return work(&progress); });
  try {
    while (!base::is_ready(result, 0.05)) watch(progress.done());
  } catch (...) {
    progress.cancel();
    result.wait();
    throw;
  }
  return result.get();
}

}  // namespace viete::library
