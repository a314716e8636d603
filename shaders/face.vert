// Plain triangles.
#version 330 core

layout(location = 0) in vec3 position;
uniform mat4 eye_from_model, clip_from_eye;
out vec3 eye_position;

void main() {
  vec4 eye = eye_from_model * vec4(position, 1.0);
  eye_position = eye.xyz;
  gl_Position = clip_from_eye * eye;
}
