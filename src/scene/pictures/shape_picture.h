// Small pictures of shapes of the model: lit, in rows of pixels, since a model has too many faces to be drawn
// one by one.
#pragma once

#include "mesh/surface.h"
#include "scene/document/camera.h"
#include "scene/pictures/picture_view.h"

namespace viete::scene {

/// On the scale of the model at rest, or of the shape where it is larger. Empty where it has no triangles.
std::vector<PictureShape> shape_picture(const mesh::Surface& model, std::span<const mesh::Point> shape,
                                        UpAxis up, glm::vec2 size);

/// As it stands in the view.
std::vector<mesh::Point> upright(std::span<const mesh::Point> points, UpAxis up);

}  // namespace viete::scene
