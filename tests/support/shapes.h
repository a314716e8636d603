// Small surfaces with known measures. Functions that read and compare surfaces.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/byte_order.h"
#include "base/error.h"
#include "formats/format_table.h"
#include "formats/read.h"
#include "formats/text_writer.h"
#include "mesh/surface.h"
#include "mesh/triangulation.h"
#include "support/folder.h"
#include "support/random.h"
#include "support/text.h"

namespace viete::test {

inline std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

using mesh::Point;
using mesh::Surface;
using mesh::Triangle;

/// Returns the cube [-1, 1]^3 as six quads, counter-clockwise as seen from outside.
inline Surface cube() {
  Surface s;
  for (int i = 0; i < 8; ++i)
    s.positions.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  s.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  s.polygon_starts = {0, 4, 8, 12, 16, 20, 24};
  mesh::triangulate(s);
  return s;
}

/// The unit sphere: subdivides each triangle into 4^levels triangles. `points` must be on the sphere.
inline Surface sphere_from(std::vector<Point> points, std::vector<Triangle> triangles, int levels) {
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (added) {
        Point p{points[a][0] + points[b][0], points[a][1] + points[b][1], points[a][2] + points[b][2]};
        const double length = std::hypot(p[0], p[1], p[2]);
        for (double& x : p) x /= length;
        points.push_back(p);
      }
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return mesh::from_triangles(points, triangles);
}

/// The unit sphere: an octahedron subdivided `levels` times, with 8 * 4^levels triangles.
inline Surface sphere(int levels) {
  return sphere_from({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                     {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
                     levels);
}

/// A torus about the z axis with radii 2 and 0.5. If `open`, one ring of quads is missing.
inline Surface torus(std::uint32_t around, std::uint32_t across, bool open = false) {
  Surface s;
  const double pi = std::acos(-1.0);
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / across, r = 2 + 0.5 * std::cos(v);
      s.positions.push_back({r * std::cos(u), r * std::sin(u), 0.5 * std::sin(v)});
    }
  s.polygon_starts = {0};
  for (std::uint32_t i = 0; i < around - (open ? 1 : 0); ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t k = (i + 1) % around, l = (j + 1) % across;
      for (const auto v : {i * across + j, k * across + j, k * across + l, i * across + l})
        s.corners.push_back(v);
      s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
    }
  mesh::triangulate(s);
  return s;
}

/// Joins two surfaces to one.
inline Surface both(Surface a, const Surface& b) {
  const auto shift = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + shift, j + shift, k + shift});
  return mesh::from_triangles(a.positions, a.triangles);
}

template <class T>
void append(std::string& bytes, T value, std::endian order = std::endian::little) {
  const auto raw = base::bytes_of_number(value, order);
  bytes.append(raw.data(), raw.size());
}

/// Scales all positions, and then adds `offset` to each coordinate.
inline Surface moved(Surface s, double scale, double offset = 0) {
  for (Point& p : s.positions)
    for (double& x : p) x = x * scale + offset;
  return s;
}

/// Returns the positions, with by * x^2 added to z.
inline std::vector<Point> raised(const Surface& s, double by) {
  std::vector<Point> posed = s.positions;
  for (Point& p : posed) p[2] += by * p[0] * p[0];
  return posed;
}

/// Returns the bytes of a file with this surface.
inline std::string bytes_by(std::string_view extension, const Surface& s,
                            const std::vector<std::string>& comments = {}) {
  return formats::written_text([&](formats::TextWriter& out) {
    formats::format_by_extension(extension)->write({s, s.positions, comments}, out);
  });
}

inline formats::ReadResult read_text(const std::string& bytes, const std::string& extension) {
  return formats::read(formats::Source{"given." + extension, extension, bytes, nullptr});
}

/// Writes a file and reads it with its original.
inline formats::ReadResult put_and_read(const std::filesystem::path& file, const std::string& bytes) {
  put_file(file, bytes);
  return formats::read(file);
}

/// Reads a file. The result owns the file's bytes, for written_again().
inline formats::ReadResult read_kept(const std::string& bytes, const std::string& extension,
                                     const std::filesystem::path& folder = {}) {
  const auto kept = std::make_shared<const std::string>(bytes);
  return formats::read(formats::Source{"given." + extension, extension, *kept, nullptr, kept, folder});
}

/// Writes the file again, with new positions. Returns the bytes.
inline std::string written_again(const formats::ReadResult& read, const std::vector<Point>& positions,
                                 formats::Digits digits = {}) {
  REQUIRE(read.original);
  return formats::written_text(
      [&](formats::TextWriter& out) {
        read.original->write({read.surface, positions, {}}, out);
      },
      digits);
}

/// Reads the bytes. Returns the message of the error, or an empty text without an error.
inline std::string refusal(const std::string& bytes, const std::string& extension) {
  try {
    read_text(bytes, extension);
  } catch (const base::Error& error) {
    CHECK(!error.place().empty());
    CHECK(!error.advice().empty());
    return error.what();
  }
  return {};
}

/// `files` are pairs of bytes and text. Checks that reading the bytes causes an error with the text.
inline void check_refusals(const std::string& extension,
                           const std::vector<std::pair<std::string, std::string>>& files) {
  for (const auto& [bytes, said] : files) {
    const std::string found = refusal(bytes, extension);
    CHECK_MESSAGE(mentions(found, said), found);
  }
}

inline void check_invariants(const Surface& s) {
  REQUIRE(s.polygon_starts.size() == s.polygon_count() + 1);
  REQUIRE(s.polygon_starts.back() == s.corners.size());
  REQUIRE(s.triangles.size() == s.corners.size() - 2 * s.polygon_count());
  REQUIRE(s.triangle_polygon.size() == s.triangles.size());
  bool in_range = true, finite = true;
  for (const auto v : s.corners) in_range &= v < s.positions.size();
  for (const auto& t : s.triangles)
    in_range &= t[0] < s.positions.size() && t[1] < s.positions.size() && t[2] < s.positions.size();
  for (const auto& p : s.positions)
    finite &= std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  CHECK(in_range);
  CHECK(finite);
}

/// Returns a band of six quads, closed with a twist.
inline mesh::Surface moebius_strip() {
  std::vector<mesh::Point> positions;
  std::vector<mesh::Triangle> triangles;
  for (std::uint32_t i = 0; i < 6; ++i) {
    for (int j = 0; j < 2; ++j) positions.push_back({std::cos(1.0 * i), std::sin(1.0 * i), 1.0 * j});
    const std::uint32_t a = 2 * i, b = a + 1, c = i < 5 ? a + 2 : 1, d = i < 5 ? a + 3 : 0;
    triangles.push_back({a, c, b});
    triangles.push_back({b, c, d});
  }
  return mesh::from_triangles(positions, triangles);
}

}  // namespace viete::test
