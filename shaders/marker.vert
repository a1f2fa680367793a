#version 330 core
// Round dots of a fixed size in pixels: two triangles per instance.

uniform samplerBuffer markers;  // two texels each: position, diameter in pixels; colour
uniform mat4 view_projection;
uniform vec2 picture_size;

out vec2 from_center;  // pixels
flat out float radius;
flat out vec3 color;

void main() {
  vec4 placed = texelFetch(markers, 2 * gl_InstanceID);
  color = texelFetch(markers, 2 * gl_InstanceID + 1).rgb;
  radius = 0.5 * placed.w;
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  from_center = corner * (radius + 1.0);
  vec4 p = view_projection * vec4(placed.xyz, 1.0);
  p.xy += from_center * 2.0 / picture_size * p.w;
  // A little nearer than it is: a dot on a vertex is not cut by the faces around it.
  p.z -= 0.004 * p.w;
  gl_Position = p;
}
