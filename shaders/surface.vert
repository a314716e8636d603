// Corners of triangles without index buffer: each knows its place in the triangle, for the wireframe. Programs that need
// only the vertex are INDEXED: a vertex is then computed once for several triangles.
#version 330 core

uniform usamplerBuffer indices;   // 3 vertex numbers per triangle
uniform usamplerBuffer vertices;  // bits of the position, and the normal: see base::pack_normal()
uniform samplerBuffer occlusion;  // per vertex
#ifdef SCALARS
uniform samplerBuffer scalars;    // per vertex
#endif
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

vec3 unpacked(uint bits) {
  vec2 at = vec2(int(bits << 16) >> 16, int(bits) >> 16) / 32767.0;
  float z = 1.0 - abs(at.x) - abs(at.y), fold = max(-z, 0.0);
  return normalize(vec3(at - mix(vec2(fold), vec2(-fold), lessThan(at, vec2(0.0))), z));
}

void main() {
#ifdef INDEXED
  int vertex = gl_VertexID;
#else
  int vertex = int(texelFetch(indices, gl_VertexID).r);
#endif
  uvec4 bits = texelFetch(vertices, vertex);
  vec3 position = uintBitsToFloat(bits.xyz), normal = unpacked(bits.w);
  if (any(isnan(position)) || any(isinf(position))) position = vec3(0.0);
  int place = gl_VertexID % 3;
  mat3 turn = mat3(eye_from_model);  // by the model's scale too large or too small to be squared
  vec3 column = abs(turn[0]);
  turn /= max(column.x, max(column.y, column.z));
  normal_and_occlusion = vec4(turn * normal, texelFetch(occlusion, vertex).r);
  corner_and_scalar = vec3(place == 0, place == 1, 0.0);
#ifdef SCALARS
  corner_and_scalar.z = texelFetch(scalars, vertex).r;
#endif
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
