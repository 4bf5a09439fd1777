#pragma once
/// What the renderer's tests draw, and with what.

#include "pipeline/gl_draw/gl_renderer.h"
#include "pipeline/target/target.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace stadion::test {

/// Pictures as the renderer returns them.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;

  const std::uint8_t* at(std::uint32_t x, std::uint32_t y) const { return rgba.data() + (y * width + x) * 4; }
  bool operator==(const Picture&) const = default;
};

/// The provider of that kind, opened once; pinned settings. Null with a test failure if it cannot be opened.
GlProvider* provider(GlProviderKind kind);

/// A context with a renderer in it, current on the thread that made it until it goes.
class Stage {
public:
  Stage(const MeshStore& meshes, std::uint32_t width, std::uint32_t height,
        GlProviderKind kind = GlProviderKind::OsMesa, RenderQuality quality = {});
  ~Stage();

  GlRenderer& renderer() { return *renderer_; }
  const GlTable& gl() const { return target_->gl(); }
  std::mutex& turns() const { return target_->turns(); }
  /// Draws and reads one eye; a problem fails the test.
  Picture draw(const DrawList& list, std::uint32_t eye = 0);

private:
  std::unique_ptr<Target> target_;
  std::unique_ptr<GlRenderer> renderer_;
};

Material matt(float r, float g, float b, float alpha = 1);

/// Meshes under construction: add faces, then seal.
class MeshMaker {
public:
  explicit MeshMaker(Material material);
  MeshMaker& texture(Texture texture);
  /// A quad a, b, c, d, counter-clockwise seen from its front; texture upright with a at the bottom left.
  MeshMaker& quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);
  MeshMaker& triangle(Vec3 a, Vec3 b, Vec3 c);
  MeshMaker& box(Vec3 lo, Vec3 hi);
  MeshMaker& sphere(double radius, int rings);
  std::unique_ptr<Mesh> seal();

private:
  std::uint32_t vertex(const Vec3& p, const Vec3& n, double u, double v);

  std::unique_ptr<Mesh> mesh_;
};

Texture chequered(std::uint32_t side, std::uint32_t squares);

DrawItem place(MeshId mesh, const Affine& X = Affine::Identity());
DrawView lookAt(const Vec3& from, const Vec3& to, double fieldOfView, double aspect);
/// Looks along World +Y with the plane y = 0 filling clip space -1..1: x to the right, z up, orthographic.
DrawView orthographic();
/// One eye, ambient light of radiance 1 from everywhere, no lights, no haze.
DrawList plainList();

/// A little of everything: plain, boxes, spheres, glass, sun, lamps.
DrawList richList(MeshStore& meshes, double aspect);

std::uint8_t sRgb(double linear);
void writePng(const Picture& picture, const std::string& name);

}  // namespace stadion::test
