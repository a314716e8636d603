// A small picture of what an entry of a chooser does, made by the deformer itself.
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
  std::vector<PictureShape> shapes;  ///< in the order in which they are drawn
  std::string_view caption;          ///< what is to be seen

  friend bool operator==(const ChoicePicture&, const ChoicePicture&) = default;
};

/// What else there is to choose is as default_scheme() has it, where that goes together. The same bits each
/// time. Takes some milliseconds.
///
/// Ways: what becomes of a bar between two ends that are turned against each other, and of which one grows.
ChoicePicture choice_picture(deform::Way way);
/// How much each place of a fork follows the end of one prong.
ChoicePicture choice_picture(deform::Weights weights);
/// The same bar as of ways.
ChoicePicture choice_picture(deform::Blend blend);

/// Each is made when it is first asked for, and kept.
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

/// Where a lattice is cut, along each axis, ascending: two places or more.
struct Lattice {
  std::vector<double> x, y, z;
};

/// True for a cell that is filled, by its place along each axis.
using Filled = std::function<bool(int x, int y, int z)>;

/// What encloses the cells that are filled: quads, outward, corners shared.
mesh::Surface lattice_surface(const Lattice& lattice, const Filled& filled);
/// All of them are.
mesh::Surface lattice_surface(const Lattice& lattice);

/// So many equal steps from low to high: steps + 1 places.
std::vector<double> even(double low, double high, int steps);

}  // namespace viete::scene
