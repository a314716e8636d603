// Squares of the ground that are in the shadow: 6 corners each, no attributes. Their corners lie on one lattice, so
// that no gaps show between them.
#version 330 core

uniform usamplerBuffer squares;  // column and row
uniform mat4 eye_from_ground, clip_from_eye;
uniform vec4 place;  // corner and size of all, on the ground
uniform vec2 share;  // of a square of all

out vec2 texel;

void main() {
  int corner = gl_VertexID % 6;
  uvec2 square = texelFetch(squares, gl_VertexID / 6).xy;
  uint right = corner == 1 || corner == 2 || corner == 4 ? 1u : 0u;
  uint upper = corner == 2 || corner == 4 || corner == 5 ? 1u : 0u;
  texel = vec2(square + uvec2(right, upper)) * share;
  gl_Position = clip_from_eye * (eye_from_ground * vec4(place.xy + texel * place.zw, 0.0, 1.0));
}
