#version 330 core
// Arrows of a fixed width in pixels: three triangles per instance, two for the shaft and one for the head.

uniform samplerBuffer arrows;  // two texels each: from, to
uniform mat4 view_projection;
uniform vec2 picture_size;
uniform float half_width;  // of the shaft, pixels

const float kHeadLength = 8.0;  // in half widths of the shaft
const float kHeadWidth = 3.4;   // half of it, likewise

void main() {
  vec4 tail = view_projection * vec4(texelFetch(arrows, 2 * gl_InstanceID).xyz, 1.0);
  vec4 tip = view_projection * vec4(texelFetch(arrows, 2 * gl_InstanceID + 1).xyz, 1.0);
  vec2 to_pixels = 0.5 * picture_size;
  vec2 way = (tip.xy / tip.w - tail.xy / tail.w) * to_pixels;
  float pixels = length(way);
  vec2 along = pixels > 1e-4 ? way / pixels : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  // A short arrow is all head, no longer than it is.
  float head = min(kHeadLength * half_width, pixels);
  float share = head / max(kHeadLength * half_width, 1e-6);
  float neck = pixels > 1e-4 ? 1.0 - head / pixels : 0.0;
  vec4 middle = mix(tail, tip, neck);
  float side = half_width;
  vec4 p = tail;
  float shift = 0.0;
  if (gl_VertexID < 6) {
    int corner = gl_VertexID < 3 ? gl_VertexID : 6 - gl_VertexID;  // 0 1 2, 3 2 1
    p = corner >= 2 ? middle : tail;
    shift = (corner & 1) == 0 ? side : -side;
  } else if (gl_VertexID == 6) {
    p = tip;
  } else {
    p = middle;
    shift = (gl_VertexID == 7 ? kHeadWidth : -kHeadWidth) * side * share;
  }
  p.xy += across * shift / to_pixels * p.w;
  // A little nearer than it is: an arrow along a surface is not cut by its faces.
  p.z -= 0.004 * p.w;
  gl_Position = p;
}
