// The Gaussian of a splat, premultiplied. SOLID ones only write the depth of places with half opacity.
#version 330 core

in vec2 at;
flat in vec4 splat_color;
out vec4 color;

void main() {
  float square = dot(at, at);
#ifdef SOLID
  if (splat_color.a * exp(-0.5 * square) < 0.5) discard;
  color = vec4(0.0);
#else
  float alpha = square > 9.0 ? 0.0 : min(0.99, splat_color.a * exp(-0.5 * square));
  color = vec4(splat_color.rgb, 1.0) * alpha;
#endif
}
