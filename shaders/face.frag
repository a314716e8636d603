// A breath of colour, a little stronger where the flat face is seen edge-on.
#version 330 core

uniform vec3 color;
uniform float opacity, rim, perspective;
in vec3 eye_position;
out vec4 result;

void main() {
  vec3 v = normalize(mix(vec3(0.0, 0.0, 1.0), -eye_position, perspective));
  vec3 n = normalize(cross(dFdx(eye_position), dFdy(eye_position)));
  float edge = 1.0 - abs(dot(n, v));
  result = vec4(color, opacity + rim * edge * edge * edge);
}
