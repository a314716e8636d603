// Coverage of a pixel by a segment with round ends.
#version 330 core

uniform float width, opacity;
uniform vec4 halo;  // instead of the line itself, if its opacity is not 0
in vec2 place;
flat in float segment_length;
flat in vec4 first_color, last_color;
out vec4 color;

void main() {
  float beyond = max(0.0, max(-place.x, place.x - segment_length));
  float distance = length(vec2(beyond, place.y));
  float coverage = clamp(0.5 * width + 0.5 - distance, 0.0, 1.0) * min(1.0, width);
  float along = segment_length > 0.0 ? clamp(place.x / segment_length, 0.0, 1.0) : 0.0;
  vec4 paint = halo.a > 0.0 ? halo : mix(first_color, last_color, along);
  color = vec4(paint.rgb, paint.a * opacity * coverage);
}
