#include "base/choice.h"

#include "document/handling.h"
#include "document/timeline.h"
#include "document/view_options.h"

namespace viete::document {

std::span<const Choice> choices(Pivot) {
  static constexpr Choice all[] = {
      {"median", "Median", "Rotate and scale about the mean of the selection."},
      {"active", "Active", "Rotate and scale about the element clicked last."},
      {"joint", "Joint", "Rotate and scale about the border of the selection, as at an elbow."},
      {"point", "Placed point", "Rotate and scale about a point that you place."}};
  return all;
}

std::span<const Choice> choices(Axes) {
  static constexpr Choice all[] = {
      {"world", "World", "Use the axes of the file."},
      {"view", "View", "Use the axes of the screen: right, up and towards the viewer."},
      {"selection", "Selection", "Use the principal axes of the selection."}};
  return all;
}

std::span<const Choice> choices(MirrorPlane) {
  static constexpr Choice all[] = {
      {"none", "Off", "Edit only the selection."},
      {"x", "X", "Mirror edits along the file's X axis."},
      {"y", "Y", "Mirror edits along the file's Y axis."},
      {"z", "Z", "Mirror edits along the file's Z axis."},
      {"fit", "Fit", "Mirror edits across the plane of symmetry that fits the cage best."}};
  return all;
}

std::span<const Choice> choices(SoftCurve) {
  static constexpr Choice all[] = {
      {"smooth", "Smooth", "Use a smooth falloff, which makes a round bump."},
      {"sharp", "Sharp", "Use a sharp falloff, which makes a tip."},
      {"linear", "Linear", "Use a linear falloff, which makes a cone."},
      {"constant", "Constant", "Use no falloff: everything within the radius moves fully."}};
  return all;
}

std::span<const Choice> choices(SoftDistance) {
  static constexpr Choice all[] = {
      {"edges", "Over edges",
       "Measure distance along cage edges. A finger then does not move the finger next to it."},
      {"space", "Through space", "Measure distance in a straight line."}};
  return all;
}

std::span<const Choice> choices(Easing) {
  static constexpr Choice all[] = {
      {"smooth", "Smooth", "Interpolate smoothly through the keys, and slow down at the first and last key."},
      {"constant_speed", "Constant speed", "Move at constant speed to the next key."},
      {"hold", "Hold", "Keep this key's pose until the next key."}};
  return all;
}

std::span<const Choice> choices(Repeat) {
  static constexpr Choice all[] = {{"once", "Once", "Stop at the last frame."},
                                   {"loop", "Loop", "After the last frame, continue from the first frame."},
                                   {"ping_pong", "Ping-pong", "Play forward and backward alternately."}};
  return all;
}

std::span<const Choice> choices(Shading) {
  static constexpr Choice all[] = {
      {"clay", "Clay", "Show the model in one matte colour."},
      {"porcelain", "Porcelain", "Show the model white and glossy. Reflections reveal uneven surfaces."},
      {"jade", "Jade", "Show the model as a translucent material."},
      {"file", "From file", "Show colours, materials and textures of the model's file; without these, clay."},
      {"checker", "Checker", "Show a checkerboard texture to judge stretching."},
      {"normals", "Normals", "Show surface normals as colours: x is red, y is green, z is blue."},
      {"zebra", "Zebra", "Show reflected stripes to judge curvature and continuity."}};
  return all;
}

}  // namespace viete::document
