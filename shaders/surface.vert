// Corners of triangles without index buffer: each knows its place in the triangle, for the wireframe.
#version 330 core

uniform usamplerBuffer indices;   // 3 vertex numbers per triangle
uniform samplerBuffer vertices;   // per vertex two: position, normal
uniform samplerBuffer looks;      // per vertex: occlusion, scalar
uniform mat4 eye_from_model, clip_from_eye;
#ifdef LOOKS
uniform samplerBuffer texture_points;  // per corner
uniform int has_texture_points;
out vec2 texture_point;
#endif
#ifdef COLORS
uniform samplerBuffer colors;  // per vertex or corner
uniform int colors_of_corners;
out vec3 vertex_color;         // in linear light
#endif
#ifdef FLAT
out vec3 eye_position;
#endif

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
#ifdef LOOKS
  texture_point = has_texture_points != 0 ? texelFetch(texture_points, gl_VertexID).xy : vec2(0.0);
#endif
#ifdef COLORS
  vec3 c = texelFetch(colors, colors_of_corners != 0 ? gl_VertexID : vertex).rgb;
  vertex_color = c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);  // sRGB to light, within 0.003
#endif
#ifdef FLAT
  eye_position = vec3(eye_from_model * vec4(position, 1.0));
#endif
  gl_Position = clip_from_eye * (eye_from_model * vec4(position, 1.0));
}
