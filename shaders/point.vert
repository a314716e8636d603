// Vertices as discs on the screen, large enough to close the gaps between neighbouring points.
#version 330 core

uniform usamplerBuffer vertices;  // bits of the position
uniform mat4 eye_from_model, clip_from_eye;
uniform float spacing, scale;  // spacing: in pixels, where w is 1; scale: pixels per logical pixel
#if defined(SCALARS)
uniform samplerBuffer scalars;  // per vertex
uniform sampler2D palette;
uniform float scalar_low, scalar_factor, palette_size;
#elif defined(COLORS)
uniform samplerBuffer colors;  // per vertex
#else
uniform vec3 model_color;
uniform vec2 depth_range;  // distances of the nearest and of the farthest points
#endif

flat out vec3 point_color;

void main() {
  vec3 position = uintBitsToFloat(texelFetch(vertices, gl_VertexID).xyz);
  vec4 eye = eye_from_model * vec4(position, 1.0);
  gl_Position = clip_from_eye * eye;
  if (any(isnan(position)) || any(isinf(position))) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = clamp(1.8 * spacing / gl_Position.w, 2.0 * scale, 6.0 * scale);
#if defined(SCALARS)
  float at = clamp((texelFetch(scalars, gl_VertexID).r - scalar_low) * scalar_factor, 0.0, 1.0);
  point_color = textureLod(palette, vec2((0.5 + at * (palette_size - 1.0)) / palette_size, 0.5), 0.0).rgb;
#elif defined(COLORS)
  point_color = texelFetch(colors, gl_VertexID).rgb;
#else
  point_color = model_color * mix(1.0, 0.2, smoothstep(depth_range.x, depth_range.y, -eye.z));
#endif
}
