#version 330 core

in vec2 from_center;
flat in float radius;
flat in vec3 color;

out vec4 fragment;

void main() {
  float r = length(from_center);
  float inside = clamp(radius + 0.5 - r, 0.0, 1.0);
  float rim = clamp(r - radius + 0.22 * radius + 0.5, 0.0, 1.0);
  fragment = vec4(mix(color, vec3(0.07, 0.08, 0.1), rim), inside);
}
