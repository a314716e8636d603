// Pulls a mesh onto the surface it stands for, and evens out its triangles.
#pragma once

#include "dragon/field.h"
#include "dragon/mesh.h"

namespace viete::dragon {

/// Moves every vertex to the zero level of the field by Newton steps along the gradient, at most reach in
/// all.
void project(Mesh& mesh, const Field& field, double reach, int steps);

/// Moves every vertex towards the mean of its neighbours, along the surface only, by the given part of the
/// way.
void even_out(Mesh& mesh, double part);

}  // namespace viete::dragon
