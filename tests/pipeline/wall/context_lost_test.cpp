/// If an OpenGL context is lost while walls are drawn, the renderer reports it, creates a new one and draws
/// the frame.

#include "pipeline/gl/gl_table.h"
#include "pipeline/wall/gl_wall_renderer.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>
#include <set>

namespace stadion {
namespace {

GLenum APIENTRY saysThatItIsLost() {
  return GL_CONTEXT_LOST;
}

/// A provider whose contexts can be lost.
class Losing final : public GlProvider {
public:
  explicit Losing(GlProvider& real) : real_(real) {}

  std::string_view name() const override { return "losing"; }
  Result<std::unique_ptr<Target>> create(std::uint32_t width, std::uint32_t height) override {
    auto real = real_.create(width, height);
    if (!real) return real.error();
    return std::unique_ptr<Target>(std::make_unique<Context>(*this, std::move(real.value())));
  }
  /// The driver gives up all contexts that there are.
  void loseAll();
  /// So many times none can be made current.
  void refuse(int times) { refusals_ = times; }

private:
  struct Context final : Target {
    Context(Losing& by, std::unique_ptr<Target> real)
        : Target(table, real->turns(), real->width(), real->height()), owner(by), target(std::move(real)),
          table(target->gl()) {
      owner.all_.insert(this);
    }
    ~Context() override { owner.all_.erase(this); }
    std::optional<Diagnostic> makeCurrent() override {
      if (owner.refusals_ == 0) return target->makeCurrent();
      --owner.refusals_;
      return Diagnostic{Severity::Error, {}, "it is gone", {}};
    }
    void release() override { target->release(); }

    Losing& owner;
    std::unique_ptr<Target> target;
    GlTable table;
  };

  GlProvider& real_;
  std::set<Context*> all_;
  int refusals_ = 0;
};

void Losing::loseAll() {
  for (Context* c : all_) c->table.GetError = saysThatItIsLost;
}

/// Two walls, drawn in turn on this thread.
class ContextLost : public ::testing::Test {
protected:
  ContextLost()
      : provider_(*test::provider(GlProviderKind::OsMesa)), list_(test::richList(meshes_, 1)),
        drawing_({provider_,
                  meshes_,
                  {{32, 32}, {32, 32}},
                  {},
                  nullptr,
                  {},
                  nullptr,
                  {},
                  {"front", "left"},
                  [this](const std::string& what) { told_.push_back(what); }}) {
    list_.ticket.signature.frame = 7;
    for (std::size_t wall = 0; wall < 2; ++wall) EXPECT_FALSE(drawing_.open(wall));
  }
  ~ContextLost() override {
    for (std::size_t wall = 0; wall < 2; ++wall) drawing_.close(wall);
  }

  Failure draw(std::size_t wall) { return drawing_.draw(wall, list_, true).failure; }
  std::vector<std::uint8_t> picture(std::size_t wall) {
    std::vector<std::uint8_t> rgba(32 * 32 * 4);
    EXPECT_FALSE(drawing_.read(wall, 0, rgba));
    return rgba;
  }

  MeshStore meshes_;
  Losing provider_;
  DrawList list_;
  std::vector<std::string> told_;
  GlWallRenderer drawing_;
};

TEST_F(ContextLost, TheFrameIsDrawnInANewOneAndThatIsTold) {
  for (std::size_t wall = 0; wall < 2; ++wall) ASSERT_FALSE(draw(wall));
  const auto before = picture(1);
  provider_.loseAll();
  for (std::size_t wall = 0; wall < 2; ++wall) {
    const Failure f = draw(wall);
    EXPECT_FALSE(f) << f->message;
  }
  EXPECT_EQ(picture(1), before);
  const std::vector<std::string> told{
      "wall front, frame 7: its OpenGL context was lost; a new one is created",
      "wall left, frame 7: its OpenGL context was lost; a new one is created"};
  EXPECT_EQ(told_, told);
}

TEST_F(ContextLost, OneThatCannotBeMadeCurrentIsLostToo) {
  ASSERT_FALSE(draw(1));  // the other one is current now
  const auto before = picture(1);
  ASSERT_FALSE(draw(0));
  provider_.refuse(1);
  const Failure f = draw(1);
  EXPECT_FALSE(f) << f->message;
  EXPECT_EQ(picture(1), before);
  EXPECT_EQ(told_.size(), 1u);
}

TEST_F(ContextLost, WithoutAnotherOneTheRunEndsWithWallAndFrame) {
  ASSERT_FALSE(draw(0));
  provider_.refuse(1000);
  const Failure f = draw(1);
  provider_.refuse(0);
  ASSERT_TRUE(f);
  EXPECT_EQ(f->message, "wall left, frame 7: its OpenGL context was lost, and there is no other: it is gone");
}

}  // namespace
}  // namespace stadion
