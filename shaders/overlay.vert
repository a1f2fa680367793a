#version 330 core
// A rectangle given in clip space.

uniform vec4 rectangle;  // x0, y0, x1, y1

void main() {
  gl_Position = vec4((gl_VertexID & 1) == 0 ? rectangle.x : rectangle.z,
                     (gl_VertexID >> 1) == 0 ? rectangle.y : rectangle.w, 0.0, 1.0);
}
