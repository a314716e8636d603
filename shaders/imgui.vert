// Panels: positions in logical pixels from the top left.
#version 330 core

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_position;
layout(location = 2) in vec4 vertex_color;
uniform vec4 placement;  // offset and factor from logical pixels to clip space
out vec2 texel;
out vec4 tint;

void main() {
  texel = texture_position;
  tint = vertex_color;
  gl_Position = vec4(position * placement.zw + placement.xy, 0.0, 1.0);
}
