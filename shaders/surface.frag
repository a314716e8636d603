// Soft studio light in view space: warm key from the upper left, cool fill from the right, rim from behind,
// sky and ground as ambient. Light is added up in linear space and shown through a soft shoulder.
#version 330 core

uniform vec3 model_color;
uniform vec4 eye_ray;  // factor and offset from pixels to the x, y of the ray whose z is -1
uniform float exposure, occlusion_strength;
#ifdef WIREFRAME
uniform vec4 wire;  // colour and opacity
uniform float wire_width;
#endif
#ifdef SCALARS
uniform sampler2D palette;
uniform float scalar_low, scalar_factor, palette_size;
#endif
#ifdef LOOKS
uniform sampler2D image;  // answers in linear light
uniform mat4 eye_from_model;
uniform vec3 run_color;
uniform int paint;  // 1 as the file says, 2 checker, 3 normals
uniform int has_image, has_texture_points;
in vec2 texture_point;
#endif
#ifdef COLORS
in vec3 vertex_color;
#endif
#ifdef FLAT
in vec3 eye_position;
#endif

in vec4 normal_and_occlusion;
in vec3 corner_and_scalar;
out vec4 color;

const vec3 key_direction = normalize(vec3(-0.62, 0.72, 0.48));
const vec3 key_color = vec3(1.00, 0.94, 0.85) * 0.95;
const vec3 fill_direction = normalize(vec3(0.85, 0.05, 0.45));
const vec3 fill_color = vec3(0.62, 0.76, 1.00) * 0.21;
const vec3 rim_direction = normalize(vec3(0.35, 0.55, -0.75));
const vec3 rim_color = vec3(0.85, 0.94, 1.00) * 0.60;
const vec3 sky_color = vec3(0.86, 0.92, 1.00) * 0.17;
const vec3 ground_color = vec3(0.75, 0.55, 0.42) * 0.11;

// Gamma 2 in and out: as good to the eye as sRGB here, and cheap where a processor draws the pixels.
vec3 to_linear(vec3 c) { return c * c; }
vec3 to_display(vec3 c) { return sqrt(c); }

// Straight up to 0.6, then bent so that nothing clips.
vec3 shoulder(vec3 c) {
  vec3 above = max(c - 0.6, 0.0);
  return min(c, 0.6) + above / (1.0 + above / 0.4);
}

// Light that wraps a little around the edge of the lit side, as from a large lamp.
float wrapped(float cosine, float wrap) { return max(0.0, (cosine + wrap) / (1.0 + wrap)); }

float power_32(float x) {
  x *= x;
  x *= x;
  x *= x;
  x *= x;
  return x * x;
}

vec3 shade(vec3 base, vec3 n, vec3 v, float open) {
  vec3 key = key_color * wrapped(dot(n, key_direction), 0.08) * mix(1.0, open, 0.7);
  vec3 fill = fill_color * wrapped(dot(n, fill_direction), 0.3);
  vec3 ambient = mix(ground_color, sky_color, 0.5 + 0.5 * n.y);
  float edge = 1.0 - max(0.0, dot(n, v));
  vec3 rim = rim_color * wrapped(dot(n, rim_direction), 0.2) * edge * edge * edge;
  float gloss = power_32(max(0.0, dot(n, normalize(key_direction + v))));
  vec3 sheen = rim * mix(base, vec3(1.0), 0.4) + 0.07 * key_color * gloss;
  return base * (key + (fill + ambient) * open) + sheen * open;
}

#if defined(PORCELAIN) || defined(JADE)
// The environment that a glossy surface mirrors: a sky that brightens upwards, a large lamp, and a window at the right.
vec3 studio(vec3 r) {
  vec3 sky = mix(vec3(0.16, 0.15, 0.15), vec3(0.80, 0.88, 1.00), smoothstep(-0.3, 0.8, r.y));
  float lamp = smoothstep(0.80, 0.93, dot(r, key_direction));
  float window = smoothstep(0.88, 0.95, dot(r, fill_direction));
  return sky + 3.2 * key_color * lamp + vec3(0.5, 0.7, 1.0) * window;
}

// Schlick's share of light that glazing mirrors.
float mirrored(vec3 n, vec3 v) {
  float edge = 1.0 - max(0.0, dot(n, v)), square = edge * edge;
  return 0.05 + 0.75 * square * square * edge;
}
#endif

#ifdef PORCELAIN
vec3 material(vec3 n, vec3 v, float open) {
  const vec3 body = vec3(0.69, 0.73, 0.77);
  vec3 light = key_color * wrapped(dot(n, key_direction), 0.35) + fill_color * wrapped(dot(n, fill_direction), 0.5);
  vec3 ambient = mix(vec3(0.16, 0.17, 0.21), vec3(0.30, 0.34, 0.40), 0.5 + 0.5 * n.y);
  vec3 diffuse = body * (0.72 * light * mix(1.0, open, 0.6) + ambient * open);
  return mix(diffuse, studio(reflect(-v, n)), mirrored(n, v) * open);
}
#endif

#ifdef JADE
// Light enters, is scattered and leaves elsewhere: it wraps far around, and thin rims glow.
vec3 material(vec3 n, vec3 v, float open) {
  const vec3 deep = vec3(0.015, 0.13, 0.085), bright = vec3(0.19, 0.52, 0.31);
  float edge = 1.0 - max(0.0, dot(n, v));
  float through = 0.75 * wrapped(dot(n, key_direction), 0.7) + 0.22 * wrapped(dot(n, rim_direction), 0.6) + 0.3 * edge * edge;
  vec3 diffuse = mix(deep, bright, clamp(through, 0.0, 1.0)) * mix(0.45, 1.0, open);
  return mix(diffuse, studio(reflect(-v, n)), mirrored(n, v) * open);
}
#endif

#ifdef ZEBRA
// Stripes of a hall of lamps, mirrored: where they bend or break, the surface's curvature does. Their edges are soft,
// and the more of them follow one another within a few pixels, as on scales, the fainter they are: it is the forms that
// are read by them.
vec3 material(vec3 n, vec3 v, float open) {
  vec3 r = reflect(-v, n);
  float at = 3.0 * r.y, width = max(fwidth(at), 1e-4);  // stripes, and how many of them a pixel takes
  float soft = max(0.07, 0.5 * width);
  float edge = smoothstep(0.25 - soft, 0.25 + soft, abs(fract(at) - 0.5));
  float stripe = mix(edge, 0.5, 0.8 * smoothstep(0.02, 0.3, width));
  float lit = (0.55 + 0.45 * max(0.0, dot(n, v))) * mix(0.6, 1.0, open);
  return mix(vec3(0.02, 0.025, 0.033), vec3(0.80), stripe) * lit;
}
#endif

#ifdef WIREFRAME
// Edge coverage: distance to the nearest edge in pixels. Where triangles shrink to a few pixels their edges become
// thinner with them, so that single ones are still seen, and all together never cover the surface.
float edges() {
  vec3 corner = vec3(corner_and_scalar.xy, 1.0 - corner_and_scalar.x - corner_and_scalar.y);
  vec3 rate = max(fwidth(corner), vec3(1e-6));
  vec3 distance = corner / rate;
  float nearest = min(distance.x, min(distance.y, distance.z));
  float height = 1.0 / max(rate.x, max(rate.y, rate.z));
  float width = wire_width * clamp(height / (10.0 * wire_width), 0.25, 1.0);
  float coverage = clamp(0.5 * width + 0.5 - nearest, 0.0, 1.0);
  return coverage * mix(0.85, 1.0, smoothstep(3.0, 14.0, height / wire_width));
}
#endif

#ifdef LOOKS
// As displayed: sRGB of light, within 0.003.
vec3 displayed(vec3 light) {
  vec3 a = sqrt(light), b = sqrt(a), c = sqrt(b);
  return clamp(0.662002687 * a + 0.684122060 * b - 0.323583601 * c - 0.0225411470 * light, 0.0, 1.0);
}

// Sixteen squares across the texture, whose tint says where: redder along u, bluer along v. Blurred evenly where
// squares become smaller than pixels.
vec3 checker() {
  if (has_texture_points == 0) return model_color;
  vec2 at = 16.0 * texture_point, width = max(fwidth(at), 1e-5);
  vec2 place = fract(at * 0.5);
  vec2 edge = clamp((abs(place - 0.5) - 0.25) * 2.0 / width + 0.5, 0.0, 1.0);
  float odd = mix(edge.x + edge.y - 2.0 * edge.x * edge.y, 0.5, smoothstep(0.6, 1.2, max(width.x, width.y)));
  vec2 along = fract(texture_point);
  vec3 dark = vec3(0.36, 0.40, 0.46) + vec3(0.20 * along.x, 0.0, 0.20 * (1.0 - along.y));
  return mix(dark, vec3(0.88, 0.86, 0.82), odd);
}

vec3 from_file() {
  vec3 light = run_color;
#ifdef COLORS
  light *= vertex_color;
#endif
  if (has_image != 0) {
    vec4 texel = texture(image, texture_point);
    if (texel.a < 0.5) discard;
    light *= texel.rgb;
  }
  return displayed(light);
}

// In the model's own axes: x red, y green, z blue.
vec3 normal_color(vec3 n) {
  mat3 turn = mat3(eye_from_model);  // by the model's scale too large or too small to be squared
  vec3 column = abs(turn[0]);
  turn /= max(column.x, max(column.y, column.z));
  return 0.5 + 0.5 * normalize(n * turn);
}
#endif

vec3 base_color() {
#ifdef SCALARS
  float at = clamp((corner_and_scalar.z - scalar_low) * scalar_factor, 0.0, 1.0);
  return texture(palette, vec2((0.5 + at * (palette_size - 1.0)) / palette_size, 0.5)).rgb;
#elif defined(LOOKS)
  return paint == 2 ? checker() : from_file();
#else
  return model_color;
#endif
}

void main() {
  vec3 v = normalize(vec3(-(gl_FragCoord.xy * eye_ray.xy + eye_ray.zw), 1.0));
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 n = normalize(normal_and_occlusion.xyz) * side;
  float open = mix(1.0, normal_and_occlusion.w, occlusion_strength) * (gl_FrontFacing ? 1.0 : 0.7);
#ifdef LOOKS
#ifdef FLAT
  n = normalize(cross(dFdx(eye_position), dFdy(eye_position)));  // the triangle's own, towards the eye
#endif
  if (paint == 3) {
    color = vec4(normal_color(n), 1.0);
#ifdef WIREFRAME
    color.rgb = mix(color.rgb, wire.rgb, wire.a * edges());
#endif
    return;
  }
#endif
#if defined(PORCELAIN) || defined(JADE) || defined(ZEBRA)
  vec3 lit = material(n, v, open);
#else
  vec3 lit = shade(to_linear(base_color()), n, v, open);
#endif
  vec3 shown = to_display(shoulder(exposure * lit));
#ifdef WIREFRAME
  shown = mix(shown, wire.rgb, wire.a * edges());
#endif
  color = vec4(shown, 1.0);
}
