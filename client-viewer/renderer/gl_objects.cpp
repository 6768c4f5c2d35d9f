#include "renderer/gl_objects.hpp"

#include <algorithm>
#include <bit>
#include <sstream>

namespace pelagos {
namespace {

/// Puts the file of each line `#include "name"` in its place.
std::string with_includes(std::string_view text) {
  constexpr std::string_view kMark = "#include \"";
  std::string whole;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, end);
    if (line.starts_with(kMark))
      whole += shader_text(line.substr(kMark.size(), line.rfind('"') - kMark.size()));
    else
      whole += line;
    text.remove_prefix(end);
  }
  return whole;
}

}  // namespace

std::string shader_source(std::string_view file, std::string_view defined) {
  const std::string_view body = shader_text(file), common = shader_text("common.glsl");
  if (body.empty() || common.empty()) throw GraphicsError("no shader named " + std::string(file) + " in this build");
  std::string macros;
  std::istringstream names{std::string(defined)};
  for (std::string name; names >> name;) macros += "#define " + name + "\n";
  return "#version 450 core\n" + macros + std::string(common) + "\n#line 1\n" + with_includes(body);
}

namespace {

GLuint compile_stage(GLenum stage, std::string_view file, std::string_view defined) {
  const std::string source = shader_source(file, defined);
  const char* text = source.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    char log[4096] = {};
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    glDeleteShader(shader);
    throw GraphicsError("shader " + std::string(file) + " does not compile:\n" + log);
  }
  return shader;
}

}  // namespace

Program::Program(std::string_view vertex_file, std::string_view fragment_file, std::string_view defined) {
  const GLuint vertex = compile_stage(GL_VERTEX_SHADER, vertex_file, defined);
  const GLuint fragment = compile_stage(GL_FRAGMENT_SHADER, fragment_file, defined);
  id_ = glCreateProgram();
  glAttachShader(id_, vertex);
  glAttachShader(id_, fragment);
  glLinkProgram(id_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint good = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &good);
  if (good == 0) {
    char log[4096] = {};
    glGetProgramInfoLog(id_, sizeof log, nullptr, log);
    throw GraphicsError("program " + std::string(vertex_file) + " + " + std::string(fragment_file) + ":\n" + log);
  }
}

Program::~Program() { glDeleteProgram(id_); }

void Program::set(const char* name, int value) const {
  glProgramUniform1i(id_, glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, float value) const {
  glProgramUniform1f(id_, glGetUniformLocation(id_, name), value);
}
void Program::set(const char* name, float x, float y) const {
  glProgramUniform2f(id_, glGetUniformLocation(id_, name), x, y);
}
void Program::set_matrix3(const char* name, const float* columns) const {
  glProgramUniformMatrix3fv(id_, glGetUniformLocation(id_, name), 1, GL_FALSE, columns);
}
void Program::set_vector3(const char* name, const float* values) const {
  glProgramUniform3fv(id_, glGetUniformLocation(id_, name), 1, values);
}
void Program::set_vector4(const char* name, const float* values) const {
  glProgramUniform4fv(id_, glGetUniformLocation(id_, name), 1, values);
}

Texture::Texture(int width, int height, GLenum format, GLenum filter, GLenum wrap, int levels)
    : width_(width), height_(height) {
  const int chain = std::bit_width(static_cast<unsigned>(std::max(width, height)));
  const int count = levels == 0 ? chain : std::min(levels, chain);
  glCreateTextures(GL_TEXTURE_2D, 1, &id_);
  glTextureStorage2D(id_, count, format, width, height);
  const GLenum minify = count > 1 && filter == GL_LINEAR ? GLenum{GL_LINEAR_MIPMAP_LINEAR} : filter;
  glTextureParameteri(id_, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minify));
  glTextureParameteri(id_, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(filter));
  glTextureParameteri(id_, GL_TEXTURE_WRAP_S, static_cast<GLint>(wrap));
  glTextureParameteri(id_, GL_TEXTURE_WRAP_T, static_cast<GLint>(wrap));
}

Texture::~Texture() { glDeleteTextures(1, &id_); }

Framebuffer::Framebuffer(std::initializer_list<const Texture*> colour, bool depth)
    : colours_(static_cast<GLint>(colour.size())),
      width_((*colour.begin())->width()),
      height_((*colour.begin())->height()) {
  glCreateFramebuffers(1, &id_);
  std::vector<GLenum> targets;
  for (const Texture* texture : colour) {
    const GLenum target = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size());
    glNamedFramebufferTexture(id_, target, texture->id(), 0);
    targets.push_back(target);
  }
  glNamedFramebufferDrawBuffers(id_, static_cast<GLsizei>(targets.size()), targets.data());
  if (depth) {
    glCreateRenderbuffers(1, &depth_);
    glNamedRenderbufferStorage(depth_, GL_DEPTH_COMPONENT32F, width_, height_);
    glNamedFramebufferRenderbuffer(id_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  }
  check();
}

Framebuffer::Framebuffer(std::initializer_list<const Texture*> colour, const Framebuffer& depth_of)
    : Framebuffer(colour) {
  glNamedFramebufferRenderbuffer(id_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_of.depth_);
  check();
}

void Framebuffer::check() const {
  if (glCheckNamedFramebufferStatus(id_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw GraphicsError("this OpenGL cannot draw into a buffer of " + std::to_string(width_) + " x " +
                        std::to_string(height_) + " pixels; try a smaller --size");
}

Framebuffer::~Framebuffer() {
  glDeleteFramebuffers(1, &id_);
  if (depth_ != 0) glDeleteRenderbuffers(1, &depth_);
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glViewport(0, 0, width_, height_);
}

namespace {

/// The bound framebuffer is emptied and takes solids: depth (reversed) hides what lies behind, nothing is blended.
void start_solids(GLuint id, GLint colours, const std::array<float, 4>& background) {
  const float far_away = 0.0F;
  glDepthMask(GL_TRUE);
  for (GLint k = 0; k < colours; ++k) glClearNamedFramebufferfv(id, GL_COLOR, k, background.data());
  glClearNamedFramebufferfv(id, GL_DEPTH, 0, &far_away);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_BLEND);
}

}  // namespace

void Framebuffer::begin_solids(const std::array<float, 4>& background) const {
  bind();
  start_solids(id_, colours_, background);
}

MultisampleTarget::MultisampleTarget(int width, int height, std::initializer_list<GLenum> formats, int samples)
    : width_(width), height_(height) {
  glCreateFramebuffers(1, &id_);
  std::vector<GLenum> targets;
  for (const GLenum format : formats) {
    colours_.push_back(0);
    glCreateRenderbuffers(1, &colours_.back());
    glNamedRenderbufferStorageMultisample(colours_.back(), samples, format, width, height);
    targets.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(targets.size()));
    glNamedFramebufferRenderbuffer(id_, targets.back(), GL_RENDERBUFFER, colours_.back());
  }
  glNamedFramebufferDrawBuffers(id_, static_cast<GLsizei>(targets.size()), targets.data());
  glCreateRenderbuffers(1, &depth_);
  glNamedRenderbufferStorageMultisample(depth_, samples, GL_DEPTH_COMPONENT32F, width, height);
  glNamedFramebufferRenderbuffer(id_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  if (glCheckNamedFramebufferStatus(id_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw GraphicsError("this OpenGL cannot draw " + std::to_string(samples) + " samples a pixel into a buffer of " +
                        std::to_string(width) + " x " + std::to_string(height) + " pixels; try a smaller --size");
}

MultisampleTarget::~MultisampleTarget() {
  glDeleteFramebuffers(1, &id_);
  glDeleteRenderbuffers(static_cast<GLsizei>(colours_.size()), colours_.data());
  glDeleteRenderbuffers(1, &depth_);
}

void MultisampleTarget::begin_solids() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glViewport(0, 0, width_, height_);
  start_solids(id_, static_cast<GLint>(colours_.size()), {});
}

void MultisampleTarget::resolve_into(const Framebuffer& target) const {
  for (std::size_t k = 0; k < colours_.size(); ++k) {
    const GLenum colour = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(k);
    glNamedFramebufferReadBuffer(id_, colour);
    glNamedFramebufferDrawBuffer(target.id(), colour);
    glBlitNamedFramebuffer(id_, target.id(), 0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
  }
}

Buffer::Buffer() { glCreateBuffers(1, &id_); }
Buffer::~Buffer() { glDeleteBuffers(1, &id_); }

void Buffer::upload(const void* data, std::size_t bytes, GLenum usage) {
  if (bytes > capacity_) {
    capacity_ = bytes + bytes / 2;
    glNamedBufferData(id_, static_cast<GLsizeiptr>(capacity_), nullptr, usage);
  }
  if (bytes > 0) glNamedBufferSubData(id_, 0, static_cast<GLsizeiptr>(bytes), data);
}

std::vector<float> read_texture(const Texture& texture, int channels) {
  const GLenum formats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  std::vector<float> values(static_cast<std::size_t>(texture.width() * texture.height() * channels));
  glGetTextureImage(texture.id(), 0, formats[channels - 1], GL_FLOAT,
                    static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
  return values;
}

void check_graphics(const char* where) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  throw GraphicsError(std::string("OpenGL error ") + std::to_string(error) + " in " + where);
}

}  // namespace pelagos
