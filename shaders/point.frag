// A disc. Without colours of the file, its darker rim separates it from discs behind it.
#version 330 core

flat in vec3 point_color;
out vec4 color;

void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  if (dot(at, at) > 1.1) discard;
  color = vec4(point_color, 1.0);
#ifndef COLORS
  color.rgb *= 1.0 - 0.4 * dot(at, at);
#endif
}
