#version 330 core
// Triangles of the interface, in pixels with y downwards.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_position;
layout(location = 2) in vec4 color;

uniform vec2 display;  // pixels

out vec2 at;
out vec4 tint;

void main() {
  at = texture_position;
  tint = color;
  gl_Position = vec4(2.0 * position.x / display.x - 1.0, 1.0 - 2.0 * position.y / display.y, 0.0, 1.0);
}
