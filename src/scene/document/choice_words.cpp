#include "base/choice.h"

#include "scene/document/handling.h"
#include "scene/document/timeline.h"
#include "scene/document/view_options.h"

namespace viete::scene {

std::span<const Choice> choices(Pivot) {
  static constexpr Choice all[] = {
      {"median", "Median", "Turn and scale about the mean of what is selected."},
      {"active", "Active", "Turn and scale about what was clicked last."},
      {"individual", "Each its own", "What hangs together turns and scales about its own middle."},
      {"joint", "Joint", "Turn and scale about the end of the selection where it joins the rest: an elbow."},
      {"point", "Placed point", "Turn and scale about a point that you place."}};
  return all;
}

std::span<const Choice> choices(Axes) {
  static constexpr Choice all[] = {
      {"world", "World", "Move along the axes of the file."},
      {"view", "View", "Move to the right, up, and towards you."},
      {"selection", "Selection", "Move along the longest extents of what is selected."},
      {"active", "Active", "Move along the longest edge and the normal of what was clicked last."},
      {"mirror", "Mirror", "Move across the mirror's plane, and in it."}};
  return all;
}

std::span<const Choice> choices(MirrorPlane) {
  static constexpr Choice all[] = {
      {"none", "Off", "Only what is selected moves."},
      {"x", "X", "What moves on one side moves on the other, across the file's X axis."},
      {"y", "Y", "What moves on one side moves on the other, across the file's Y axis."},
      {"z", "Z", "What moves on one side moves on the other, across the file's Z axis."},
      {"fit", "Fit", "What moves on one side moves on the other, across the plane that fits the cage best."}};
  return all;
}

std::span<const Choice> choices(SoftCurve) {
  static constexpr Choice all[] = {
      {"smooth", "Smooth", "Near the selection and near the radius the share changes little."},
      {"sharp", "Sharp", "The share falls quickly: a tip."},
      {"linear", "Linear", "The share falls evenly: a cone."},
      {"constant", "Constant", "All within the radius moves in full."}};
  return all;
}

std::span<const Choice> choices(SoftDistance) {
  static constexpr Choice all[] = {
      {"edges", "Over edges", "Distances are taken along the cage's edges: fingers do not move each other."},
      {"space", "Through space", "Distances are taken straight, whatever lies between."}};
  return all;
}

std::span<const Choice> choices(Easing) {
  static constexpr Choice all[] = {
      {"smooth", "Smooth", "Flows through the keys, and comes to rest at the first and the last one."},
      {"linear", "Linear", "At an even speed from this key to the next one."},
      {"hold", "Hold", "Stays at this key until the next one."}};
  return all;
}

std::span<const Choice> choices(Repeat) {
  static constexpr Choice all[] = {{"once", "Once", "Stops at the last frame."},
                                   {"loop", "Loop", "After the last frame comes the first one."},
                                   {"ping_pong", "To and fro", "At either end it turns round."}};
  return all;
}

std::span<const Choice> choices(Shading) {
  static constexpr Choice all[] = {
      {"clay", "Clay", "Show the mesh in one calm colour."},
      {"porcelain", "Porcelain", "Show the mesh white and glazed: its reflections tell how smooth it is."},
      {"jade", "Jade", "Show the mesh as if light went through it: soft forms, bright rims."},
      {"file", "As it is",
       "Show the colours, materials and textures of the mesh's file; clay where it has none."},
      {"checker", "Checker",
       "Show squares along the texture coordinates, to see how the deformation stretches them."},
      {"normals", "Normals", "Show where the mesh faces: x as red, y as green, z as blue."},
      {"zebra", "Zebra", "Show mirrored stripes, which bend with the curvature and break where it does."}};
  return all;
}

}  // namespace viete::scene
