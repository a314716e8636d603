// Makes captures (Gaussian splats) in PLY and SPZ files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/shapes.h"

namespace viete::test {

/// A PLY file of a capture. Number p of row v is value(v, p).
struct CapturePly {
  std::string format = "binary_little_endian";
  std::vector<std::string> names = {"x", "y", "z"};  ///< of float properties
  std::size_t count = 4;
  std::string before = "comment trained for 30,000 steps\n", after = "";  ///< lines around the vertices
  std::string lead = "", tail = "";                                       ///< bytes around the vertices
  std::function<float(std::size_t, std::size_t)> value = [](std::size_t v, std::size_t p) {
    return 0.25F * static_cast<float>(p) - 1.5F * static_cast<float>(v) + 0.125F;
  };

  /// Adds the properties of splats.
  CapturePly& with(std::size_t harmonics) {
    for (const char* name : {"nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"}) names.emplace_back(name);
    for (std::size_t i = 0; i < harmonics; ++i) names.push_back("f_rest_" + std::to_string(i));
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
      names.emplace_back(name);
    return *this;
  }

  std::size_t at(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  }

  std::string header() const {
    std::string text =
        "ply\nformat " + format + " 1.0\n" + before + "element vertex " + std::to_string(count) + "\n";
    for (const std::string& name : names) text += "property float " + name + "\n";
    return text + after + "end_header\n";
  }

  std::string bytes() const {
    std::string all = header() + lead;
    const auto order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
    for (std::size_t v = 0; v < count; ++v)
      for (std::size_t p = 0; p < names.size(); ++p) {
        if (format != "ascii") {
          append(all, value(v, p), order);
          continue;
        }
        char digits[32];
        all.append(digits, std::to_chars(digits, digits + sizeof digits, value(v, p)).ptr);
        all += p + 1 == names.size() ? " \n" : " ";
      }
    return all + tail;
  }
};

/// Writes the file again with these positions and splats. Returns the bytes.
inline std::string posed_bytes(const formats::ReadResult& read, const std::vector<Point>& positions,
                               const mesh::Splats* splats, std::span<const std::uint32_t> sources = {}) {
  REQUIRE(read.original);
  return formats::written_text([&](formats::TextWriter& out) {
    read.original->write({read.surface, positions, {}, nullptr, splats, sources}, out);
  });
}

}  // namespace viete::test
