// Gaussian splats: the sizes, rotations and colours of a capture's vertices.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace viete::mesh {

/// The Gaussians at the vertices of a surface without polygons, in the conventions of B. Kerbl et al., 3D
/// Gaussian Splatting for Real-Time Radiance Field Rendering, 2023. Arrays have one entry per vertex, in
/// vertex order. The covariance of a splat is R diag(exp(2 s)) R^T, where R is the rotation of its quaternion
/// and s its log_scales. Numbers are those of the file: quaternions need not have length 1, and values need
/// not be finite.
struct Splats {
  std::vector<std::array<float, 3>>
      log_scales;  ///< natural logarithms of the standard deviations along the axes
  std::vector<std::array<float, 4>> rotations;  ///< quaternions w, x, y, z
  std::vector<float> opacities;                 ///< logits: the opacity is 1 / (1 + exp(-value))
  std::vector<std::array<float, 3>> colors;     ///< coefficients of the constant harmonic: red, green, blue
  /// Coefficients of the other real spherical harmonics: for each vertex 3 * bands(), first all of red, then
  /// all of green, then all of blue. Empty if degree is 0.
  std::vector<float> harmonics;
  int degree = 0;  ///< of the spherical harmonics, 0 to 3

  std::size_t size() const { return opacities.size(); }
  /// True if the opacity is below 0.05 or NaN.
  bool is_faint(std::size_t i) const { return !(opacities[i] >= -2.9444390F); }  // the logit of 0.05
  /// The number of harmonics besides the constant one: 0, 3, 8 or 15.
  std::size_t bands() const { return static_cast<std::size_t>(degree * (degree + 2)); }
  /// Sets the number of splats. `degree` must be set before.
  void resize(std::size_t count) {
    log_scales.resize(count);
    rotations.resize(count);
    opacities.resize(count);
    colors.resize(count);
    harmonics.resize(3 * bands() * count);
  }
};

}  // namespace viete::mesh
