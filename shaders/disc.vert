// Points widened to squares on screen: 6 corners a point, no attributes.
#version 330 core

uniform samplerBuffer points, looks;  // looks: per disc the colour, then (radius, ring, -, -)
uniform mat4 eye_from_model, clip_from_eye;
uniform vec2 viewport;
uniform float scale;

out vec2 offset;  // device pixels from the middle
flat out vec4 disc_color;
flat out vec2 shape;  // radius in device pixels, ring

void main() {
  int disc = gl_VertexID / 6, corner = gl_VertexID % 6;
  disc_color = texelFetch(looks, 2 * disc);
  shape = texelFetch(looks, 2 * disc + 1).xy * vec2(scale, 1.0);
  float reach = shape.x + 7.0 * scale + 1.0;
  vec2 direction = vec2(corner == 1 || corner == 2 || corner == 4 ? 1.0 : -1.0,
                        corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0);
  offset = direction * reach;
  vec4 eye = eye_from_model * vec4(texelFetch(points, disc).xyz, 1.0);
  vec4 clip = clip_from_eye * eye;
  // Nearer to the eye by a few of its radii, so that slanted faces around the point do not cut into the disc.
  float depth_shift = (0.0071 + 2.5 * shape.x / (0.5 * viewport.y)) * clip.w / clip_from_eye[1][1];
  vec4 nearer = clip_from_eye * vec4(eye.xy, eye.z + depth_shift, 1.0);
  float depth = nearer.w > 0.0 ? max(nearer.z / nearer.w, -1.0) : -1.0;
  gl_Position = vec4(clip.xy / clip.w + offset / (0.5 * viewport), depth, 1.0);
  if (clip.z < -clip.w || shape.x <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
