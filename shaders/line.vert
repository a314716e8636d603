// Segments widened to quads on screen: 6 corners a segment, no attributes.
#version 330 core

uniform usamplerBuffer segments;  // two point numbers
uniform samplerBuffer points, colors;  // colours: two a segment, of its ends
uniform mat4 eye_from_model, clip_from_eye;
uniform vec2 viewport;
uniform float width;    // device pixels

out vec2 place;  // pixels along and across the segment, from its first end
flat out float segment_length;
flat out vec4 first_color, last_color;

// Clip position with a depth a little nearer to the eye than the truth: lines win over faces they lie on. Nearer by a
// share of what the view is high there, which a perspective and an orthographic camera have in common.
vec4 project(uint point) {
  vec4 eye = eye_from_model * vec4(texelFetch(points, int(point)).xyz, 1.0);
  vec4 clip = clip_from_eye * eye;
  vec4 nearer = clip_from_eye * vec4(eye.xy, eye.z + 0.0053 * clip.w / clip_from_eye[1][1], 1.0);
  clip.z = clip.w > 0.0 && nearer.w > 0.0 ? max(nearer.z / nearer.w * clip.w, -clip.w) : clip.z;
  return clip;
}

void main() {
  int segment = gl_VertexID / 6, corner = gl_VertexID % 6;
  uvec2 ends = texelFetch(segments, segment).xy;
  first_color = texelFetch(colors, 2 * segment);
  last_color = texelFetch(colors, 2 * segment + 1);
  vec4 a = clip_from_eye * (eye_from_model * vec4(texelFetch(points, int(ends.x)).xyz, 1.0));
  vec4 b = clip_from_eye * (eye_from_model * vec4(texelFetch(points, int(ends.y)).xyz, 1.0));
  float front_a = a.z + a.w, front_b = b.z + b.w;  // distance in front of the near plane
  vec4 near_a = project(ends.x), near_b = project(ends.y);
  if (front_a < 0.0) near_a = mix(a, b, front_a / (front_a - front_b));
  if (front_b < 0.0) near_b = mix(b, a, front_b / (front_b - front_a));

  vec2 screen_a = 0.5 * viewport * near_a.xy / near_a.w, screen_b = 0.5 * viewport * near_b.xy / near_b.w;
  segment_length = length(screen_b - screen_a);
  vec2 along = segment_length > 1e-4 ? (screen_b - screen_a) / segment_length : vec2(1.0, 0.0);
  float reach = 0.5 * width + 1.0;
  bool last = corner == 1 || corner == 2 || corner == 4;
  float side = corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0;
  place = vec2(last ? segment_length + reach : -reach, side * reach);
  vec2 screen = last ? screen_b + along * reach : screen_a - along * reach;
  screen += vec2(-along.y, along.x) * side * reach;
  vec4 end = last ? near_b : near_a;
  gl_Position = vec4(screen / (0.5 * viewport), end.z / end.w, 1.0);  // w = 1: `place` is linear on screen
  if (front_a < 0.0 && front_b < 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // wholly behind the eye
}
