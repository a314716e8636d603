// A picture of splats. SOLID ones only write the depth of places with half opacity.
#version 330 core

uniform sampler2D colors, depths;
out vec4 color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  color = texelFetch(colors, at, 0);
#ifdef SOLID
  if (color.a < 0.5) discard;
#else
  if (color.a == 0.0) discard;
#endif
  gl_FragDepth = texelFetch(depths, at, 0).r;
}
