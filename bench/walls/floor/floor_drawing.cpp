#include "bench/walls/floor/floor_drawing.h"

#include "bench/walls/floor/gl.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace stadion::bench {
namespace {

struct Corner {
  float position[3], normal[3];
  std::uint8_t colour[4];
};

constexpr const char* kFragment = R"(#version 330 core
in vec3 c;
out vec4 colour;
void main() { colour = vec4(c, 1); })";

/// The drawing methods differ in the source of the matrix to the eye.
std::string vertexShader(const char* matrix, const char* value) {
  return std::string("#version 330 core\n"
                     "layout(location = 0) in vec3 position;\nlayout(location = 1) in vec3 normal;\n"
                     "layout(location = 2) in vec3 vertexColour;\n") +
         matrix +
         "uniform mat4 projection;\nuniform vec3 light;\nout vec3 c;\n"
         "void main() {\n  mat4 m = " +
         value +
         ";\n  gl_Position = projection * (m * vec4(position, 1));\n"
         "  c = vertexColour * (0.25 + 0.75 * max(dot(mat3(m) * normal, light), 0));\n}\n";
}

GLuint shader(GLenum kind, const std::string& text) {
  const GLuint made = glCreateShader(kind);
  const char* source = text.c_str();
  glShaderSource(made, 1, &source, nullptr);
  glCompileShader(made);
  GLint ok = 0;
  glGetShaderiv(made, GL_COMPILE_STATUS, &ok);
  if (ok) return made;
  char log[1000];
  glGetShaderInfoLog(made, sizeof log, nullptr, log);
  std::fprintf(stderr, "stadion-walls-floor: %s\n", log);
  std::exit(3);
}

GLuint programFor(FloorWay way) {
  const std::string vertex = way == FloorWay::Instanced
                                 ? vertexShader("layout(location = 3) in mat4 toEye;\n", "toEye")
                             : way == FloorWay::Merged ? vertexShader("", "mat4(1)")
                                                       : vertexShader("uniform mat4 toEye;\n", "toEye");
  const GLuint program = glCreateProgram();
  glAttachShader(program, shader(GL_VERTEX_SHADER, vertex));
  glAttachShader(program, shader(GL_FRAGMENT_SHADER, kFragment));
  glLinkProgram(program);
  return program;
}

Corner cornerOf(const WallVertex& v) {
  Corner c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c.position[i] = static_cast<float>(v.position[i]);
    c.normal[i] = static_cast<float>(v.normal[i]);
    c.colour[i] = v.colour[i];
  }
  c.colour[3] = 255;
  return c;
}

void fill(GLenum target, GLuint buffer, const auto& values) {
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(values[0])), values.data(),
               GL_STATIC_DRAW);
}

const void* offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

void cornersFrom(GLuint buffer) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  for (GLuint i = 0; i < 3; ++i) glEnableVertexAttribArray(i);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), offset(offsetof(Corner, position)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), offset(offsetof(Corner, normal)));
  glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Corner), offset(offsetof(Corner, colour)));
}

/// Models are +Y up.
Mat4 nodeMatrix(const WallNode& node) {
  Mat4 up = Mat4::Identity();
  up.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Mat4 place = Mat4::Identity();
  place.topLeftCorner<3, 3>() = Eigen::AngleAxisd(node.heading, Vec3::UnitZ()).toRotationMatrix();
  place.topRightCorner<3, 1>() = node.position;
  return place * up;
}

/// Returns true if the sphere about the eye's point p reaches into all six planes.
bool seen(const Mat4& projection, const Vec3& p, double radius) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1.0, -1.0}) {
      const Eigen::RowVector4d plane = projection.row(3) + side * projection.row(axis);
      if (plane.head<3>().dot(p) + plane[3] < -radius * plane.head<3>().norm()) return false;
    }
  return true;
}

}  // namespace

std::optional<FloorWay> floorWay(const std::string& name) {
  constexpr const char* kNames[] = {"clear", "uniform", "discard", "instanced", "merged"};
  for (std::size_t i = 0; i < std::size(kNames); ++i)
    if (name == kNames[i]) return static_cast<FloorWay>(i);
  return std::nullopt;
}

FloorDrawing::FloorDrawing(const WallScene& scene, FloorWay way)
    : scene_(scene), way_(way), rest_(wallNodes(scene)), program_(programFor(way)) {
  std::vector<Corner> corners;
  for (std::uint32_t k = 0; k < kWallMeshes; ++k) {
    meshes_.push_back(wallMesh(scene, k));
    radii_.push_back(meshes_.back().radius());
    for (const WallVertex& v : meshes_.back().vertices) corners.push_back(cornerOf(v));
  }
  // All meshes have the same triangles; only the places of their corners differ.
  const std::vector<std::uint16_t> indices(meshes_[0].indices.begin(), meshes_[0].indices.end());
  glGenVertexArrays(1, &layout_);
  glBindVertexArray(layout_);
  glGenBuffers(1, &corners_);
  glGenBuffers(1, &indices_);
  fill(GL_ARRAY_BUFFER, corners_, corners);
  fill(GL_ELEMENT_ARRAY_BUFFER, indices_, indices);
  cornersFrom(corners_);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glDisable(GL_DITHER);
  glClearColor(0.10f, 0.12f, 0.20f, 1);
  glUseProgram(program_);
  const auto place = [&](const char* name) { return glGetUniformLocation(program_, name); };
  projection_ = place("projection");
  light_ = place("light");
  toEye_ = place("toEye");
}

FloorView FloorDrawing::view(std::size_t wall, int eye, double t) {
  const WallView at = wallView(scene_, wall, eye, t);
  FloorView view;
  view.projection = at.projection.cast<float>();
  view.light = (at.view.topLeftCorner<3, 3>() * raised(0.3, 1, 0.5).normalized()).cast<float>();
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    const WallNode node = scene_.moves(i) ? movedNode(rest_[i], i, t) : rest_[i];
    const Vec3 p = (at.view * node.position.homogeneous()).head<3>();
    if (!seen(at.projection, p, radii_[node.mesh])) continue;
    view.visible.push_back({(at.view * nodeMatrix(node)).cast<float>(), node.mesh});
    view.triangles += meshes_[node.mesh].indices.size() / 3;
  }
  std::ranges::stable_sort(view.visible, {}, &FloorView::Node::mesh);
  if (way_ == FloorWay::Instanced) prepareInstances(view);
  if (way_ == FloorWay::Merged) prepareMerged(view);
  return view;
}

void FloorDrawing::prepareInstances(FloorView& view) const {
  std::vector<Eigen::Matrix4f> matrices;
  for (const FloorView::Node& n : view.visible) matrices.push_back(n.toEye);
  glGenBuffers(1, &view.prepared);
  fill(GL_ARRAY_BUFFER, view.prepared, matrices);
}

void FloorDrawing::prepareMerged(FloorView& view) const {
  std::vector<Corner> corners;
  std::vector<std::uint32_t> indices;
  for (const FloorView::Node& n : view.visible) {
    for (const std::uint32_t index : meshes_[n.mesh].indices)
      indices.push_back(static_cast<std::uint32_t>(corners.size()) + index);
    for (const WallVertex& v : meshes_[n.mesh].vertices) {
      Corner c = cornerOf(v);
      const Eigen::Vector3f p = (n.toEye * Eigen::Map<Eigen::Vector3f>(c.position).homogeneous()).head<3>(),
                            m = n.toEye.topLeftCorner<3, 3>() * Eigen::Map<Eigen::Vector3f>(c.normal);
      std::memcpy(c.position, p.data(), sizeof c.position);
      std::memcpy(c.normal, m.data(), sizeof c.normal);
      corners.push_back(c);
    }
  }
  glGenBuffers(1, &view.prepared);
  glGenBuffers(1, &view.indices);
  fill(GL_ARRAY_BUFFER, view.prepared, corners);
  fill(GL_ELEMENT_ARRAY_BUFFER, view.indices, indices);
}

void FloorDrawing::draw(const FloorView& view) const {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (way_ == FloorWay::Clear) return;
  glUniformMatrix4fv(projection_, 1, GL_FALSE, view.projection.data());
  glUniform3fv(light_, 1, view.light.data());
  if (way_ == FloorWay::Discard) glEnable(GL_RASTERIZER_DISCARD);
  if (way_ == FloorWay::Instanced)
    drawInstances(view);
  else if (way_ == FloorWay::Merged)
    drawMerged(view);
  else
    drawEach(view);
  glDisable(GL_RASTERIZER_DISCARD);
}

void FloorDrawing::drawEach(const FloorView& view) const {
  const auto indices = static_cast<GLsizei>(meshes_[0].indices.size());
  const auto corners = static_cast<GLint>(meshes_[0].vertices.size());
  for (const FloorView::Node& n : view.visible) {
    glUniformMatrix4fv(toEye_, 1, GL_FALSE, n.toEye.data());
    glDrawElementsBaseVertex(GL_TRIANGLES, indices, GL_UNSIGNED_SHORT, nullptr,
                             corners * static_cast<GLint>(n.mesh));
  }
}

void FloorDrawing::drawInstances(const FloorView& view) const {
  const auto indices = static_cast<GLsizei>(meshes_[0].indices.size());
  const auto corners = static_cast<GLint>(meshes_[0].vertices.size());
  glBindBuffer(GL_ARRAY_BUFFER, view.prepared);
  for (std::size_t first = 0, end = 0; first < view.visible.size(); first = end) {
    while (end < view.visible.size() && view.visible[end].mesh == view.visible[first].mesh) ++end;
    for (GLuint column = 0; column < 4; ++column) {
      glEnableVertexAttribArray(3 + column);
      glVertexAttribDivisor(3 + column, 1);
      glVertexAttribPointer(3 + column, 4, GL_FLOAT, GL_FALSE, 64, offset(first * 64 + column * 16));
    }
    glDrawElementsInstancedBaseVertex(GL_TRIANGLES, indices, GL_UNSIGNED_SHORT, nullptr,
                                      static_cast<GLsizei>(end - first),
                                      corners * static_cast<GLint>(view.visible[first].mesh));
  }
}

void FloorDrawing::drawMerged(const FloorView& view) const {
  cornersFrom(view.prepared);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, view.indices);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * view.triangles), GL_UNSIGNED_INT, nullptr);
}

void FloorDrawing::free(FloorView& view) const {
  const GLuint names[] = {view.prepared, view.indices};
  glDeleteBuffers(2, names);  // OpenGL ignores names that are 0
  view.prepared = view.indices = 0;
}

}  // namespace stadion::bench
