#include "render/shader_program.h"

#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "mesh/error.h"

namespace isorelax::render {
namespace {

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

GLuint compile(GLenum kind, const ShaderSource& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.text.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  glDeleteShader(shader);
  log.resize(static_cast<std::size_t>(length));
  throw Error(source.name + ": " + first_line(log));
}

}  // namespace

ShaderProgram::ShaderProgram(const ShaderSource& vertex, const ShaderSource& fragment) {
  const GLuint first = compile(GL_VERTEX_SHADER, vertex);
  GLuint second = 0;
  try {
    second = compile(GL_FRAGMENT_SHADER, fragment);
  } catch (...) {
    glDeleteShader(first);
    throw;
  }
  name_ = glCreateProgram();
  glAttachShader(name_, first);
  glAttachShader(name_, second);
  glLinkProgram(name_);
  glDeleteShader(first);
  glDeleteShader(second);
  GLint good = GL_FALSE;
  glGetProgramiv(name_, GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  glDeleteProgram(name_);
  throw Error(vertex.name + " and " + fragment.name + ": " + first_line(log));
}

ShaderProgram::ShaderProgram(ShaderProgram&& other) noexcept : name_(std::exchange(other.name_, 0)) {}

ShaderProgram& ShaderProgram::operator=(ShaderProgram&& other) noexcept {
  std::swap(name_, other.name_);
  return *this;
}

ShaderProgram::~ShaderProgram() {
  if (name_ != 0) glDeleteProgram(name_);
}

void ShaderProgram::use() const {
  glUseProgram(name_);
}

GLint ShaderProgram::location(const char* uniform) const {
  return glGetUniformLocation(name_, uniform);
}

void ShaderProgram::set(const char* uniform, int value) const {
  glUniform1i(location(uniform), value);
}
void ShaderProgram::set(const char* uniform, unsigned value) const {
  glUniform1ui(location(uniform), value);
}
void ShaderProgram::set(const char* uniform, float value) const {
  glUniform1f(location(uniform), value);
}
void ShaderProgram::set(const char* uniform, Color value) const {
  glUniform3f(location(uniform), static_cast<float>(value.red) / 255.0F,
              static_cast<float>(value.green) / 255.0F, static_cast<float>(value.blue) / 255.0F);
}
void ShaderProgram::set(const char* uniform, const glm::vec2& value) const {
  glUniform2fv(location(uniform), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* uniform, const glm::vec4& value) const {
  glUniform4fv(location(uniform), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* uniform, const glm::ivec2& value) const {
  glUniform2iv(location(uniform), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* uniform, const glm::mat3& value) const {
  glUniformMatrix3fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void ShaderProgram::set(const char* uniform, const glm::mat4& value) const {
  glUniformMatrix4fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace isorelax::render
