#include "base/choice.h"

#include "document/handling.h"
#include "document/timeline.h"
#include "document/view_options.h"

namespace viete::document {

std::span<const Choice> choices(Pivot) {
  static constexpr Choice all[] = {
      {"median", "Median", "Rotate and scale about the mean of the selection."},
      {"active", "Active", "Rotate and scale about the element clicked last."},
      {"joint", "Joint", "Rotate and scale about the border of the selected part, like an elbow."},
      {"point", "Placed point", "Rotate and scale about a point that you place."}};
  return all;
}

std::span<const Choice> choices(Axes) {
  static constexpr Choice all[] = {
      {"world", "World", "Move along the axes of the file."},
      {"view", "View", "Move along the screen axes: right, up and towards the viewer."},
      {"selection", "Selection", "Move along the principal axes of the selection."}};
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
      {"smooth", "Smooth", "Smooth falloff, flat at the selection and at the radius."},
      {"sharp", "Sharp", "Sharp falloff that makes a tip."},
      {"linear", "Linear", "Linear falloff that makes a cone."},
      {"constant", "Constant", "No falloff: everything within the radius moves fully."}};
  return all;
}

std::span<const Choice> choices(SoftDistance) {
  static constexpr Choice all[] = {
      {"edges", "Over edges",
       "Measure distance along cage edges, so that adjacent fingers do not move each other."},
      {"space", "Through space", "Measure straight distance through space."}};
  return all;
}

std::span<const Choice> choices(Easing) {
  static constexpr Choice all[] = {
      {"smooth", "Smooth",
       "Interpolate smoothly through all keys; start and stop slowly at the first and last key."},
      {"linear", "Linear", "Move at constant speed to the next key."},
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
      {"porcelain", "Porcelain", "Show the model white and glossy; reflections reveal uneven surfaces."},
      {"jade", "Jade", "Show the model as a translucent material."},
      {"file", "From file",
       "Show the colours, materials and textures of the model's file. Models without them look like clay."},
      {"checker", "Checker", "Show a checkerboard in texture coordinates to judge stretching."},
      {"normals", "Normals", "Show normals as colours: x red, y green, z blue."},
      {"zebra", "Zebra", "Show reflected stripes to judge curvature and continuity."}};
  return all;
}

}  // namespace viete::document
