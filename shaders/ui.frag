#version 330 core
uniform sampler2D picture;

in vec2 at;
in vec4 tint;
out vec4 color;

void main() {
  color = tint * texture(picture, at);
}
