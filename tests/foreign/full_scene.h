// A small scene with content of every kind.
#pragma once

#include "foreign/scene.h"

namespace viete::test {

/// A quad and a triangle with two materials, colours, two images and a morph target.
inline foreign::Scene full_scene() {
  foreign::Scene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 2, 0.25}};
  scene.corners = {0, 1, 2, 3, 3, 2, 4};
  scene.polygon_starts = {0, 4, 7};
  formats::Attributes& a = scene.attributes;
  a.texture_points = {{0, 0}, {1, 0}, {1, 1}};
  a.corner_texture = {0, 1, 2, 2, mesh::none, 1, 0};
  a.normals = {{0, 0, 1}, {0, 0, -1}};
  a.corner_normal = {0, 0, 0, 0, 1, 1, mesh::none};
  a.colors.assign(5, {0.25F, 0.5F, 0.75F, 1});
  a.groups = {{0, "box", "side", 1, true}, {1, "box", "", mesh::none, false}};
  a.materials = {{.name = "red", .base_color = {1, 0, 0, 1}, .metallic = 1, .emission_image = 0},
                 {.name = "wood",
                  .base_color = {1, 1, 1, 0.5F},
                  .roughness = 0.25F,
                  .base_color_image = 1,
                  .is_translucent = true,
                  .repeats = false}};
  a.images = {{"/folder/a.png", nullptr, "a.png"},
              {{}, std::make_shared<const std::string>("\x89PNG"), "b.png"}};
  scene.targets = {{"smile", scene.positions}};
  scene.targets[0].positions[4][2] = 3;
  scene.notes = {"a note"};
  scene.ignored = {"skins"};
  return scene;
}

}  // namespace viete::test
