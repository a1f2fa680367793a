#version 330 core
// A bitmap, one texel per pixel, colours multiplied by alpha.

uniform sampler2D bitmap;  // first row at the top
uniform ivec2 lower_left;  // of the bitmap, in pixels of the picture

out vec4 fragment;

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy) - lower_left;
  fragment = texelFetch(bitmap, ivec2(p.x, textureSize(bitmap, 0).y - 1 - p.y), 0);
}
