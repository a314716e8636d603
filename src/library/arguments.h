// Arguments and results of the public header: conversion, checks, and long work with a Watch.
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/background.h"
#include "base/error.h"
#include "base/progress.h"
#include "library/deform.h"
#include "mesh/surface.h"

namespace viete::library {

std::vector<mesh::Point> inside(std::span<const Point3> points);
std::vector<Point3> outside(std::span<const mesh::Point> points);

/// Throws base::Error for `what` ("the model") on invalid indices, faces of fewer than three corners, and
/// coordinates that are not finite or beyond largest_coordinate.
mesh::Surface surface_of(const Mesh& mesh, const char* what);
/// Limit of coordinates of deformable surfaces, as in `viete deform`.
inline constexpr double most_deformable = 1e60;
mesh::Surface deformable_surface_of(const Mesh& mesh, const char* what);
Mesh mesh_of(const mesh::Surface& surface);

/// Throws base::Error unless there are `vertices` points, all within most_deformable.
std::vector<mesh::Point> deformable(std::vector<mesh::Point> points, std::size_t vertices, const char* what);
/// The same for three numbers per vertex.
std::vector<mesh::Point> deformable_points(std::span<const double> numbers, std::size_t vertices,
                                           const char* what);
/// Checks results. Throws base::Error with `advice`.
void check_finite(std::span<const mesh::Point> points, const char* what, const char* advice);

/// Formats a number briefly: "0.0015", "20000".
inline std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// The value of that name in the table. Throws base::Error for `what` that lists the valid names.
template <class Entry>
auto named(std::span<const Entry> table, const std::string& name, const char* what) {
  std::string names;
  for (const Entry& entry : table) {
    if (entry.name == name) return entry.value;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw base::Error(what, "unknown name " + name, "choose one of " + names);
}

/// Throws base::Error that names the valid range.
inline void check_range(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw base::Error(what, plain(value) + " is out of range", "choose " + plain(low) + " to " + plain(high));
}

template <class Impl, class... Arguments>
Hidden<Impl> hidden(Arguments&&... arguments) {
  return {new Impl(std::forward<Arguments>(arguments)...), [](Impl* impl) { delete impl; }};
}

/// The settings of Blending with their values, for docstrings: "\nway: ...\n  'smooth': ...".
std::string settings_text();

/// 0 for all processors.
inline int checked_threads(int threads) {
  check_range("threads", threads, 0, 1024);
  return threads;
}

/// Runs work(base::Progress*) in another thread while this one reports its progress. The pointer is null
/// without a watch; then, or if the system cannot start a thread, the work runs in the calling thread.
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
