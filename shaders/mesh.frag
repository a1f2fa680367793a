#version 330 core
// Two-sided shading that leaves colours readable. With LINES defined: a wire and marked edges, anti-aliased, from
// barycentric coordinates. Without it the shader stays short: software renderers run it for a block of pixels per
// triangle, and triangles are small.

in float facing;
in vec3 barycentric;
flat in vec4 color;
flat in uint marks;

uniform float relief;  // 0: no shading at all, 1: full
uniform bool backs_marked;
uniform bool faces_inward;  // the backs look at the eye where the surface is seen from outside
#ifdef LINES
uniform bool faces_shown;
uniform bool wire_shown;
uniform vec4 wire_color;         // rgb, opacity
uniform float wire_half_width;   // pixels
uniform bool marks_shown;
uniform vec3 marks_color;
uniform vec3 crease_color;
uniform float marks_half_width;  // pixels
uniform vec3 highlight_color;
#endif

out vec4 fragment;

#ifdef LINES
float line(float distance_to_edge, float half_width) {
  return 1.0 - smoothstep(half_width - 0.5, half_width + 0.5, distance_to_edge);
}

// How much of the pixel is wire. Where triangles are a few pixels wide their lines would paint everything over: they fade.
float wire(vec3 dx, vec3 dy, float nearest) {
  float area = 0.5 / max(abs(dx.x * dy.y - dx.y * dy.x), 1e-6);
  return wire_color.a * smoothstep(2.0, 9.0, sqrt(area)) * line(nearest, wire_half_width);
}

vec4 with_lines(vec3 c) {
  vec3 dx = dFdx(barycentric);
  vec3 dy = dFdy(barycentric);
  vec3 pixels = barycentric / max(sqrt(dx * dx + dy * dy), 1e-6);
  float nearest = min(pixels.x, min(pixels.y, pixels.z));
  if (!faces_shown) return vec4(wire_color.rgb, wire(dx, dy, nearest));
  if (wire_shown) c = mix(c, wire_color.rgb, wire(dx, dy, nearest));
  if (color.a < 0.5) c = mix(c, highlight_color, line(nearest, 2.0 * marks_half_width));
  if (marks_shown && marks != 0u) {
    float marked = 1e6;
    float crease = 1e6;
    for (int k = 0; k < 3; ++k) {
      if ((marks & (1u << uint(k))) != 0u) marked = min(marked, pixels[k]);
      if ((marks & (8u << uint(k))) != 0u) crease = min(crease, pixels[k]);
    }
    c = mix(c, marks_color, line(marked, marks_half_width));
    c = mix(c, crease_color, line(crease, marks_half_width));
  }
  return vec4(c, 1.0);
}
#endif

void main() {
  // 1 for a face that looks straight at the eye: a flat mesh seen from above has exactly the legend's colours.
  float light = 0.42 + clamp(gl_FrontFacing ? facing : -facing, 0.0, 0.66);
  vec3 c = color.rgb * mix(1.0, light, relief);
  // The back of a face: wine-red, whatever its colour.
  if (backs_marked && gl_FrontFacing == faces_inward) c = mix(c, vec3(0.56, 0.09, 0.2), 0.75);
#ifdef LINES
  fragment = with_lines(c);
#else
  fragment = vec4(c, 1.0);
#endif
}
