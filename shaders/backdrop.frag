// A vertical gradient; noise of one level breaks up the bands that 8 bits would show.
#version 330 core

uniform vec3 top, bottom;
in float height;
out vec4 color;

// Interleaved gradient noise (J. Jimenez, "Next generation post processing in Call of Duty", 2014).
float noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

void main() {
  vec3 gradient = mix(bottom, top, smoothstep(0.0, 1.0, height));
  color = vec4(gradient + (noise(gl_FragCoord.xy) - 0.5) / 255.0, 1.0);
}
