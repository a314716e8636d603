// One triangle that covers the whole target.
#version 330 core

uniform vec2 heights;  // of the target: where it begins in the picture, and how much of it it is
out float height;  // 0 at the bottom, 1 at the top

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = heights.x + heights.y * (0.5 + 0.5 * corner.y);
  gl_Position = vec4(corner, 0.0, 1.0);
}
