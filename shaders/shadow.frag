// Darkness of the ground; noise of less than a level breaks up bands.
#version 330 core

uniform sampler2D darkness;
uniform vec4 color;
in vec2 texel;
out vec4 result;

// Interleaved gradient noise (J. Jimenez, "Next generation post processing in Call of Duty", 2014).
float noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

void main() {
  float dark = texture(darkness, texel).r;
  result = vec4(color.rgb, color.a * dark * (0.96 + 0.08 * noise(gl_FragCoord.xy)));
}
