// Fine and strong lines of constant width on screen, faded with distance, density and grazing angle.
#version 330 core

uniform mat4 eye_from_ground;
uniform vec2 phase;  // of the center within a period of ten cells
uniform float cell, radius, line_width, perspective;
uniform vec4 color;
in vec2 ground;
in vec3 eye_position;
out vec4 result;

// Coverage by lines at the multiples of `period`; fades out where they come closer than a few pixels.
float lines(vec2 position, vec2 texel, float period) {
  vec2 density = texel / period;  // periods per pixel
  vec2 distance = abs(fract(position / period + 0.5) - 0.5) / density;
  vec2 coverage = clamp(0.5 * line_width + 0.5 - distance, 0.0, 1.0);
  coverage *= 1.0 - smoothstep(0.08, 0.35, density);
  return max(coverage.x, coverage.y);
}

void main() {
  vec2 position = ground + phase;
  vec2 right = dFdx(ground), up_screen = dFdy(ground);
  vec2 texel = sqrt(right * right + up_screen * up_screen);
  float coverage = max(0.45 * lines(position, texel, cell), lines(position, texel, 10.0 * cell));
  vec3 up = normalize(eye_from_ground[2].xyz);
  float slope = dot(normalize(mix(vec3(0.0, 0.0, 1.0), -eye_position, perspective)), up);
  float seen = smoothstep(0.0, 0.35, abs(slope)) * (slope < 0.0 ? 0.35 : 1.0);
  float near = 1.0 - smoothstep(0.15, 1.0, length(ground) / radius);
  result = vec4(color.rgb, 0.5 * color.a * coverage * seen * near * near);
}
