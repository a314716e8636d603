// Splats widened to the boxes around their ellipses: 6 corners a splat, no attributes.
#version 330 core

uniform usamplerBuffer ellipses;  // 2 texels per splat, see SplatLayer::Ellipse
uniform vec2 viewport;

out vec2 at;  // in standard deviations from the middle
flat out vec4 splat_color;

vec2 halves(uint bits) { return vec2(bits & 0xffffu, bits >> 16) / 65535.0; }

void main() {
  int splat = gl_VertexID / 6, corner = gl_VertexID % 6;
  uvec4 center = texelFetch(ellipses, 2 * splat), axes = texelFetch(ellipses, 2 * splat + 1);
  vec2 rg = halves(center.w), blue_opacity = halves(axes.w);
  splat_color = vec4(4.0 * rg, 4.0 * blue_opacity.x, blue_opacity.y);
#ifdef SOLID
  float half_opacity = 2.0 * log(2.0 * splat_color.a);  // squared deviations where the opacity is a half
  float reach = sqrt(max(half_opacity, 0.0));
#else
  float reach = min(3.0, sqrt(2.0 * log(max(255.0 * splat_color.a, 1.0))));
#endif
  vec2 direction = vec2(corner == 1 || corner == 2 || corner == 4 ? 1.0 : -1.0,
                        corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0);
  at = direction * reach;
  vec2 long_axis = uintBitsToFloat(axes.xy);
  vec2 short_axis = normalize(vec2(-long_axis.y, long_axis.x)) * uintBitsToFloat(axes.z);
  vec2 offset = at.x * long_axis + at.y * short_axis;
  gl_Position = vec4(uintBitsToFloat(center.xy) + offset / (0.5 * viewport), uintBitsToFloat(center.z), 1.0);
}
