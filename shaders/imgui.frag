// Colour times texture, as Dear ImGui expects.
#version 330 core

uniform sampler2D image;
in vec2 texel;
in vec4 tint;
out vec4 color;

void main() { color = tint * texture(image, texel); }
