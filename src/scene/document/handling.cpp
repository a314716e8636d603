#include "scene/document/handling.h"

namespace viete::scene {

std::span<const HandChoice> choices(Pivot) {
  static constexpr HandChoice all[] = {
      {"median", "Median", "Turn and scale about the mean of what is selected."},
      {"active", "Active", "Turn and scale about what was clicked last."},
      {"individual", "Each its own", "What hangs together turns and scales about its own middle."},
      {"joint", "Joint", "Turn and scale about the end of the selection where it joins the rest: an elbow."},
      {"point", "Placed point", "Turn and scale about a point that you place."}};
  return all;
}

std::span<const HandChoice> choices(Axes) {
  static constexpr HandChoice all[] = {
      {"world", "World", "Move along the axes of the file."},
      {"view", "View", "Move to the right, up, and towards you."},
      {"selection", "Selection", "Move along the longest extents of what is selected."},
      {"active", "Active", "Move along the longest edge and the normal of what was clicked last."},
      {"mirror", "Mirror", "Move across the mirror's plane, and in it."}};
  return all;
}

std::span<const HandChoice> choices(MirrorPlane) {
  static constexpr HandChoice all[] = {
      {"none", "Off", "Only what is selected moves."},
      {"x", "X", "What moves on one side moves on the other, across the file's X axis."},
      {"y", "Y", "What moves on one side moves on the other, across the file's Y axis."},
      {"z", "Z", "What moves on one side moves on the other, across the file's Z axis."},
      {"fit", "Fit", "What moves on one side moves on the other, across the plane that fits the cage best."}};
  return all;
}

std::span<const HandChoice> choices(SoftCurve) {
  static constexpr HandChoice all[] = {
      {"smooth", "Smooth", "Near the selection and near the radius the share changes little."},
      {"sharp", "Sharp", "The share falls quickly: a tip."},
      {"linear", "Linear", "The share falls evenly: a cone."},
      {"constant", "Constant", "All within the radius moves in full."}};
  return all;
}

std::span<const HandChoice> choices(SoftDistance) {
  static constexpr HandChoice all[] = {
      {"edges", "Over edges", "Distances are taken along the cage's edges: fingers do not move each other."},
      {"space", "Through space", "Distances are taken straight, whatever lies between."}};
  return all;
}

}  // namespace viete::scene
