#include "tests/pipeline/gl_draw/renderer_scene.h"

#include "pipeline/target/rasteriser_settings.h"

#include <gtest/gtest.h>
#include <png.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <numbers>

namespace stadion::test {

GlProvider* provider(GlProviderKind kind) {
  static std::mutex opening;
  static std::unique_ptr<GlProvider> opened[2];
  const std::lock_guard lock(opening);
  auto& slot = opened[kind == GlProviderKind::Egl];
  if (slot) return slot.get();
  const auto settings = pinRasteriser();
  EXPECT_FALSE(settings) << settings->message;
  auto result = openGlProvider(kind);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  if (result) slot = std::move(result.value());
  return slot.get();
}

Stage::Stage(const MeshStore& meshes, std::uint32_t width, std::uint32_t height, GlProviderKind kind,
             RenderQuality quality) {
  auto target = provider(kind)->create(width, height);
  EXPECT_TRUE(target) << (target ? "" : target.error().message);
  target_ = std::move(target.value());
  const auto bound = target_->makeCurrent();
  EXPECT_FALSE(bound) << bound->message;
  auto renderer = GlRenderer::create(target_->gl(), target_->turns(), meshes, width, height, quality);
  EXPECT_TRUE(renderer) << (renderer ? "" : renderer.error().message);
  renderer_ = std::move(renderer.value());
}

Stage::~Stage() {
  renderer_.reset();
  target_->release();
}

Picture Stage::draw(const DrawList& list, std::uint32_t eye) {
  const auto drawn = renderer_->draw(list, eye);
  EXPECT_FALSE(drawn) << drawn->message;
  Picture picture{renderer_->width(), renderer_->height(), {}};
  picture.rgba.resize(std::size_t{picture.width} * picture.height * 4);
  const auto read = renderer_->read(eye, picture.rgba);
  EXPECT_FALSE(read) << read->message;
  return picture;
}

Material matt(float r, float g, float b, float alpha) {
  Material m;
  m.baseColour = {r, g, b, alpha};
  m.roughness = 1;
  return m;
}

MeshMaker::MeshMaker(Material material) : mesh_(std::make_unique<Mesh>()) {
  mesh_->materials.push_back(std::move(material));
}

MeshMaker& MeshMaker::texture(Texture texture) {
  mesh_->textures.push_back(std::move(texture));
  mesh_->materials[0].maps[kBaseMap].texture = 0;
  return *this;
}

std::uint32_t MeshMaker::vertex(const Vec3& p, const Vec3& n, double u, double v) {
  const auto narrow = [](const Vec3& a) {
    return std::array<float, 3>{static_cast<float>(a.x()), static_cast<float>(a.y()),
                                static_cast<float>(a.z())};
  };
  mesh_->positions.push_back(narrow(p));
  mesh_->normals.push_back(narrow(n));
  mesh_->uvs.push_back({static_cast<float>(u), static_cast<float>(v)});
  return static_cast<std::uint32_t>(mesh_->positions.size() - 1);
}

MeshMaker& MeshMaker::quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 n = (b - a).cross(d - a).normalized();
  const std::uint32_t i = vertex(a, n, 0, 1);
  vertex(b, n, 1, 1), vertex(c, n, 1, 0), vertex(d, n, 0, 0);
  mesh_->indices.insert(mesh_->indices.end(), {i, i + 1, i + 2, i, i + 2, i + 3});
  return *this;
}

MeshMaker& MeshMaker::triangle(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = (b - a).cross(c - a).normalized();
  const std::uint32_t i = vertex(a, n, 0, 1);
  vertex(b, n, 1, 1), vertex(c, n, 0, 0);
  mesh_->indices.insert(mesh_->indices.end(), {i, i + 1, i + 2});
  return *this;
}

MeshMaker& MeshMaker::box(Vec3 lo, Vec3 hi) {
  const auto p = [&](int corner) {
    return Vec3(corner & 1 ? hi.x() : lo.x(), corner & 2 ? hi.y() : lo.y(), corner & 4 ? hi.z() : lo.z());
  };
  return quad(p(0), p(1), p(5), p(4))
      .quad(p(1), p(3), p(7), p(5))
      .quad(p(3), p(2), p(6), p(7))
      .quad(p(2), p(0), p(4), p(6))
      .quad(p(4), p(5), p(7), p(6))
      .quad(p(2), p(3), p(1), p(0));
}

MeshMaker& MeshMaker::sphere(double radius, int rings) {
  const auto first = static_cast<std::uint32_t>(mesh_->positions.size());
  const int slices = 2 * rings;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s <= slices; ++s) {
      const double v = double(r) / rings, u = double(s) / slices;
      const double around = 2 * std::numbers::pi * (s % slices) / slices;
      const double across = r == 0 || r == rings ? 0 : std::sin(std::numbers::pi * v);
      const Vec3 n(across * std::cos(around), across * std::sin(around), std::cos(std::numbers::pi * v));
      vertex(radius * n, n, u, v);
    }
  const auto at = [&](int r, int s) { return first + static_cast<std::uint32_t>(r * (slices + 1) + s); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < slices; ++s) {
      if (r > 0) mesh_->indices.insert(mesh_->indices.end(), {at(r, s), at(r + 1, s), at(r, s + 1)});
      if (r < rings - 1)
        mesh_->indices.insert(mesh_->indices.end(), {at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
    }
  return *this;
}

std::unique_ptr<Mesh> MeshMaker::seal() {
  static std::atomic<std::uint64_t> next{1};
  mesh_->submeshes.push_back({0, static_cast<std::uint32_t>(mesh_->indices.size()), 0});
  mesh_->hash = next++;  // every mesh of a test is another one
  mesh_->name = "mesh " + std::to_string(mesh_->hash);
  return std::move(mesh_);
}

Texture chequered(std::uint32_t side, std::uint32_t squares) {
  Texture t{side, side, {}, "chequered"};
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const bool dark = (x * squares / side + y * squares / side) % 2;
      for (const int c : {dark ? 150 : 225, dark ? 60 : 215, dark ? 50 : 190, 255})
        t.rgba.push_back(static_cast<std::uint8_t>(c));
    }
  return t;
}

DrawItem place(MeshId mesh, const Affine& X) {
  DrawItem item;
  item.mesh = mesh;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      item.model[static_cast<std::size_t>(4 * r + c)] = static_cast<float>(X.matrix()(r, c));
  return item;
}

DrawView lookAt(const Vec3& from, const Vec3& to, double fieldOfView, double aspect) {
  const Vec3 back = (from - to).normalized();
  const Vec3 right = Vec3(0, 0, 1).cross(back).normalized();
  DrawView eye;
  eye.view.topLeftCorner<3, 3>() << right.transpose(), back.cross(right).transpose(), back.transpose();
  eye.view.topRightCorner<3, 1>() = -eye.view.topLeftCorner<3, 3>() * from;
  const double near = 0.1, far = 1000, f = 1 / std::tan(fieldOfView / 2);
  eye.projection.setZero();
  eye.projection(0, 0) = f / aspect;
  eye.projection(1, 1) = f;
  eye.projection(2, 2) = near / (far - near);
  eye.projection(2, 3) = far * near / (far - near);
  eye.projection(3, 2) = -1;
  return eye;
}

DrawView orthographic() {
  DrawView eye;
  eye.view << 1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, -10, 0, 0, 0, 1;
  eye.projection(2, 2) = 1.0 / 99;
  eye.projection(2, 3) = 100.0 / 99;
  return eye;
}

DrawList plainList() {
  DrawList list;
  list.viewCount = 1;
  list.views.fill(orthographic());
  list.sky.ambient = {1, 1, 1};
  list.sky.ground = {0.7f, 0.7f, 0.7f};  // so that the light is the same from above and below
  return list;
}

namespace {

Affine at(double x, double y, double z) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(x, y, z);
  return X;
}

std::vector<DrawLight> sunLampAndSpot() {
  DrawLight sun;
  sun.direction = {-0.45f, 0.35f, -0.82f};
  sun.colour = {1.0f, 0.95f, 0.85f};
  DrawLight lamp;
  lamp.kind = DrawLight::Kind::Point;
  lamp.position = {-2.2f, -1, 0.6f};
  lamp.colour = {0.2f, 0.5f, 1.5f};
  lamp.range = 2.5f;
  DrawLight spot;
  spot.kind = DrawLight::Kind::Spot;
  spot.position = {2.5f, 0, 4};
  spot.direction = {0, 0.1f, -1};
  spot.colour = {1.5f, 0.9f, 0.3f};
  spot.range = 8;
  spot.cosInner = 0.96f;
  spot.cosOuter = 0.93f;
  return {sun, lamp, spot};
}

void addGroundAndCrates(MeshStore& meshes, DrawList& list) {
  MeshMaker plain(matt(0.32f, 0.36f, 0.24f));
  plain.quad(Vec3(-200, -200, 0), Vec3(200, -200, 0), Vec3(200, 200, 0), Vec3(-200, 200, 0));
  MeshMaker crate(matt(1, 1, 1));
  crate.texture(chequered(256, 4)).box(Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 1));
  list.opaque.push_back(place(meshes.add(plain.seal())));
  const MeshId crates = meshes.add(crate.seal());
  Affine turned = at(-1.6, 0.5, 0);
  turned.linear() = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  for (const Affine& X : {turned, at(3, 8, 0), at(-6, 20, 0)}) list.opaque.push_back(place(crates, X));
}

void addBallsAndGlass(MeshStore& meshes, DrawList& list) {
  Material red = matt(0.6f, 0.05f, 0.04f);
  red.roughness = 0.25f;
  MeshMaker ball(red);
  ball.sphere(0.5, 24);
  Material gold = matt(0.9f, 0.6f, 0.2f);
  gold.roughness = 0.35f;
  gold.metallic = 1;
  MeshMaker metal(gold);
  metal.sphere(0.4, 24);
  MeshMaker pane(matt(0.3f, 0.7f, 0.5f, 0.45f));
  pane.quad(Vec3(-0.6, 0, 0), Vec3(0.6, 0, 0), Vec3(0.6, 0, 1.4), Vec3(-0.6, 0, 1.4));

  const MeshId balls = meshes.add(ball.seal());
  list.opaque.push_back(place(balls, at(0, 0, 0.5)));
  Affine egg = at(0.1, 2.5, 0.8);
  egg.linear() = Vec3(0.8, 0.8, -1.6).asDiagonal();  // stretched and mirrored
  list.opaque.push_back(place(balls, egg));
  list.opaque.push_back(place(meshes.add(metal.seal()), at(1.5, 0.4, 0.4)));
  list.transparent.push_back(place(meshes.add(pane.seal()), at(0.75, -1, 0)));
}

}  // namespace

DrawList richList(MeshStore& meshes, double aspect) {
  DrawList list;
  list.viewCount = 2;
  for (int eye = 0; eye < 2; ++eye)
    list.views[static_cast<std::size_t>(eye)] =
        lookAt(Vec3(-0.032 + 0.064 * eye, -6, 1.7), Vec3(0, 0, 0.9), 1.1, aspect);
  list.sky.hazeDistance = 300;
  list.lights = sunLampAndSpot();
  addGroundAndCrates(meshes, list);
  addBallsAndGlass(meshes, list);
  return list;
}

std::uint8_t sRgb(double linear) {
  const double s = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

void writePng(const Picture& picture, const std::string& name) {
  const std::string folder = std::string(STADION_BINARY_DIR) + "/pictures";
  std::filesystem::create_directories(folder);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = picture.width;
  image.height = picture.height;
  image.format = PNG_FORMAT_RGBA;
  ASSERT_TRUE(png_image_write_to_file(&image, (folder + "/" + name + ".png").c_str(), 0, picture.rgba.data(),
                                      0, nullptr));
}

}  // namespace stadion::test
