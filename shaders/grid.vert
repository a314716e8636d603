// A square of the ground around its center.
#version 330 core

uniform mat4 eye_from_ground, clip_from_eye;
uniform float radius;
out vec2 ground;  // position on the ground relative to the center
out vec3 eye_position;

void main() {
  ground = radius * vec2(gl_VertexID % 2 * 2 - 1, gl_VertexID / 2 * 2 - 1);
  vec4 eye = eye_from_ground * vec4(ground, 0.0, 1.0);
  eye_position = eye.xyz;
  gl_Position = clip_from_eye * eye;
}
