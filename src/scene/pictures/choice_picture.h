// A small preview of a chooser's entry, computed by the deformer itself.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "deform/scheme.h"
#include "mesh/surface.h"
#include "scene/pictures/picture_view.h"

namespace viete::scene {

/// Logical pixels.
inline constexpr glm::vec2 choice_picture_size{264, 132};

struct ChoicePicture {
  std::vector<PictureShape> shapes;  ///< in drawing order
  std::string_view caption;          ///< description of the picture

  friend bool operator==(const ChoicePicture&, const ChoicePicture&) = default;
};

/// Other settings are those of default_scheme(), if compatible. Deterministic. Takes some milliseconds.
///
/// Way: a bar between two ends that are rotated against each other, one of which is enlarged.
ChoicePicture choice_picture(deform::Way way);
/// The influence of one prong's end on a fork.
ChoicePicture choice_picture(deform::Weights weights);
/// The same bar as for ways.
ChoicePicture choice_picture(deform::Blend blend);

/// Creates each picture on first use and caches it.
class ChoicePictures {
public:
  template <class Choice>
  const ChoicePicture& of(Choice choice) {
    auto& kept = std::get<std::map<Choice, ChoicePicture>>(kept_);
    const auto found = kept.find(choice);
    return found != kept.end() ? found->second : kept.emplace(choice, made(choice)).first->second;
  }

private:
  template <class Choice>
  static ChoicePicture made(Choice choice) {
    try {
      return choice_picture(choice);
    } catch (const base::Error&) {
      return {{}, "Not enough memory for a picture."};
    }
  }

  std::tuple<std::map<deform::Way, ChoicePicture>, std::map<deform::Weights, ChoicePicture>,
             std::map<deform::Blend, ChoicePicture>>
      kept_;
};

/// Grid planes along each axis, ascending; at least two per axis.
struct Lattice {
  std::vector<double> x, y, z;
};

/// True for a filled cell, by its index along each axis.
using Filled = std::function<bool(int x, int y, int z)>;

/// The boundary of the filled cells: quads, facing outward, with shared corners.
mesh::Surface lattice_surface(const Lattice& lattice, const Filled& filled);
/// With all cells filled.
mesh::Surface lattice_surface(const Lattice& lattice);

/// Equally spaced values from low to high: steps + 1 of them.
std::vector<double> even(double low, double high, int steps);

}  // namespace viete::scene
