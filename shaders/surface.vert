// Corners of triangles without index buffer: each knows its place in the triangle, for the wireframe.
#version 330 core

uniform usamplerBuffer indices;   // 3 vertex numbers per triangle
uniform samplerBuffer vertices;   // per vertex two: position, normal
uniform samplerBuffer looks;      // per vertex: occlusion, scalar
uniform mat4 eye_from_model, clip_from_eye;

out vec4 normal_and_occlusion;
out vec3 corner_and_scalar;  // two of the barycentric coordinates, scalar

void main() {
  int vertex = int(texelFetch(indices, gl_VertexID).r);
  vec3 position = texelFetch(vertices, 2 * vertex).xyz;
  vec3 normal = texelFetch(vertices, 2 * vertex + 1).xyz;
  vec2 look = texelFetch(looks, vertex).xy;
  if (any(isnan(position)) || any(isinf(position))) position = vec3(0.0);
  int place = gl_VertexID % 3;
  mat3 turn = mat3(eye_from_model);  // by the model's scale too large or too small to be squared
  vec3 column = abs(turn[0]);
  turn /= max(column.x, max(column.y, column.z));
  normal_and_occlusion = vec4(turn * normal, look.x);
  corner_and_scalar = vec3(place == 0, place == 1, look.y);
  gl_Position = clip_from_eye * (eye_from_model * vec4(position, 1.0));
}
