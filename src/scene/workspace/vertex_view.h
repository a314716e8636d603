// The sum at a vertex that a person has picked, made ready to be drawn.
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
  /// One element of the cage, and what it adds.
  struct Term {
    std::uint32_t element;
    double weight;
    glm::dmat3 map{1};                  ///< exp(Y) exp(X): what it would do alone
    mesh::Point at;                     ///< the element's centre, file units
    std::array<double, 3> eigenvalues;  ///< of the symmetric sum up to this term, ascending
  };
  /// How a method takes the exponential of the whole sum.
  struct Way {
    Method method;
    std::string route;
    double error;  ///< relative, against 106 bits
  };

  std::optional<std::uint32_t> vertex;  ///< that was asked for
  bool appearing = false;               ///< just now: its section is to be scrolled to
  std::vector<Term> terms;              ///< the largest first
  bool has_logs = false;                ///< else only weights are told
  glm::dmat3 map{1};                    ///< of the whole sum
  double degrees = 0;                   ///< that its rotation turns by
  std::vector<Way> ways;
};

}  // namespace viete::scene
