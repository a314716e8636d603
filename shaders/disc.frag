// A filled disc with a thin edge, and a ring around it if asked, which is as strong where the disc is hidden.
#version 330 core

uniform vec3 outline_color, ring_color;
uniform float opacity, scale;
in vec2 offset;
flat in vec4 disc_color;
flat in vec2 shape;
out vec4 color;

float inside(float distance, float radius) { return clamp(radius + 0.5 - distance, 0.0, 1.0); }

void main() {
  float distance = length(offset);
  float fill = inside(distance, shape.x);
  float body = inside(distance, shape.x + 1.25 * scale);
  float ring = shape.y * (inside(distance, shape.x + 4.5 * scale) - inside(distance, shape.x + 3.0 * scale));
  color = vec4(mix(outline_color, disc_color.rgb, fill), disc_color.a * body * opacity);
  if (ring > color.a) color = vec4(ring_color, ring);
  if (color.a <= 0.0) discard;
}
