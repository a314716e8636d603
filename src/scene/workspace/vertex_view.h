// The vertex inspector's data for a picked vertex.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesh/surface.h"
#include "scene/workspace/frame_stats.h"

namespace viete::scene {

struct VertexView {
  /// One element of the cage and its contribution.
  struct Term {
    std::uint32_t element;
    double weight;
    glm::dmat3 map{1};                  ///< exp(Y) exp(X): its effect alone
    mesh::Point at;                     ///< the element's center, file units
    std::array<double, 3> eigenvalues;  ///< eigenvalues of the symmetric sum up to this term, ascending
  };
  /// The exponential of the whole sum by one method.
  struct Way {
    Method method;
    std::string route;
    double error;  ///< relative, against 106 bits
  };

  std::optional<std::uint32_t> vertex;  ///< the picked vertex
  bool appearing = false;               ///< just picked: scroll to its section
  std::vector<Term> terms;              ///< by decreasing weight
  bool has_logs = false;                ///< false: weights only
  glm::dmat3 map{1};                    ///< map of the whole sum
  double degrees = 0;                   ///< rotation angle of the map
  std::vector<Way> ways;
};

}  // namespace viete::scene
