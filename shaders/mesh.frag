#version 330 core
// Two-sided shading that leaves colours readable, with an anti-aliased wire from barycentric coordinates.

in vec3 normal;
in vec3 barycentric;
flat in vec4 color;
flat in uint marks;

uniform bool wire_shown;
uniform vec4 wire_color;         // rgb, opacity
uniform float wire_half_width;   // pixels
uniform bool marks_shown;
uniform vec3 marks_color;
uniform float marks_half_width;  // pixels
uniform vec3 highlight_color;
uniform float relief;            // 0: no shading at all, 1: full

out vec4 fragment;

// 1 for a face that looks straight at the eye, so that a flat mesh seen from above has exactly the legend's
// colours; a little more to the upper left, less where the surface turns away.
float shade(vec3 n) {
  float head = 0.42 + 0.58 * n.z;
  float key = dot(n.xy, vec2(-0.16, 0.26));
  return mix(1.0, clamp(head + key, 0.0, 1.08), relief);
}

float line(float distance_to_edge, float half_width) {
  return 1.0 - smoothstep(half_width - 0.5, half_width + 0.5, distance_to_edge);
}

void main() {
  vec3 n = normal / max(length(normal), 1e-20);
  if (!gl_FrontFacing) n = -n;
  n.z = max(n.z, 0.0);
  vec3 c = color.rgb * shade(n);
  // The back of a face: darker and wine-red, whatever its colour.
  if (!gl_FrontFacing) c = mix(c, vec3(0.42, 0.08, 0.16), 0.72);

  vec3 dx = dFdx(barycentric);
  vec3 dy = dFdy(barycentric);
  vec3 per_pixel = max(sqrt(dx * dx + dy * dy), 1e-6);
  vec3 pixels = barycentric / per_pixel;
  float area = 0.5 / max(abs(dx.x * dy.y - dx.y * dy.x), 1e-6);
  if (wire_shown) {
    float nearest = min(pixels.x, min(pixels.y, pixels.z));
    float fade = smoothstep(2.0, 9.0, sqrt(area));
    c = mix(c, wire_color.rgb, wire_color.a * fade * line(nearest, wire_half_width));
  }
  if (color.a < 0.5) {
    float nearest = min(pixels.x, min(pixels.y, pixels.z));
    c = mix(c, highlight_color, line(nearest, 2.0 * marks_half_width));
  }
  if (marks_shown && marks != 0u) {
    float nearest = 1e6;
    for (int k = 0; k < 3; ++k)
      if ((marks & (1u << uint(k))) != 0u) nearest = min(nearest, pixels[k]);
    c = mix(c, marks_color, line(nearest, marks_half_width));
  }
  fragment = vec4(c, 1.0);
}
