// Corners of triangles without index buffer: each knows its place in the triangle, for the wireframe.
#version 330 core

uniform usamplerBuffer indices;   // 3 vertex numbers per triangle
uniform samplerBuffer vertices;   // per vertex: position and occlusion, normal and scalar
uniform mat4 eye_from_model, clip_from_eye;

out vec4 normal_and_occlusion;
out vec3 corner_and_scalar;  // two of the barycentric coordinates, scalar

void main() {
  int vertex = 2 * int(texelFetch(indices, gl_VertexID).r);
  vec4 first = texelFetch(vertices, vertex);
  vec4 second = texelFetch(vertices, vertex + 1);
  int place = gl_VertexID % 3;
  mat3 turn = mat3(eye_from_model);  // by the model's scale too large or too small to be squared
  vec3 column = abs(turn[0]);
  turn /= max(column.x, max(column.y, column.z));
  normal_and_occlusion = vec4(turn * second.xyz, first.w);
  corner_and_scalar = vec3(place == 0, place == 1, second.w);
  gl_Position = clip_from_eye * (eye_from_model * vec4(first.xyz, 1.0));
}
