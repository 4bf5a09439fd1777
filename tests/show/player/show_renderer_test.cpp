/// What draws a show: as asked for, else a graphics card, else the processors.

#include "show/player/show_renderer.h"

#include "pipeline/target/graphics_card.h"
#include "show/player/player.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

std::unique_ptr<ShowRenderer> rendererFor(const RendererSettings& settings) {
  auto renderer = ShowRenderer::open(settings);
  EXPECT_TRUE(renderer);
  return renderer ? std::move(renderer.value()) : nullptr;
}

TEST(ShowRenderer, TheProcessorsDrawWithAsManyThreadsAsAskedFor) {
  const auto renderer = rendererFor({RendererChoice::Cpu, {}, 3});
  EXPECT_EQ(renderer->kind(), RendererKind::Cpu);
  EXPECT_FALSE(renderer->drawsWithGl() || renderer->drawsNothing() || renderer->drawsOnCard());
  EXPECT_EQ(renderer->threads(), 3U);
  EXPECT_EQ(renderer->why(), "") << "it was asked for";
  EXPECT_GE(rendererFor({RendererChoice::Cpu})->threads(), 1U);
}

TEST(ShowRenderer, OpenGlDrawsIfItIsAskedFor) {
  const auto renderer = rendererFor({RendererChoice::Gl, GlProviderKind::OsMesa});
  EXPECT_EQ(renderer->kind(), RendererKind::OsMesa);
  EXPECT_TRUE(renderer->drawsWithGl());
  EXPECT_FALSE(renderer->drawsOnCard());
  EXPECT_EQ(renderer->threads(), 0U);
}

TEST(ShowRenderer, WithoutAGraphicsCardTheProcessorsDraw) {
  if (graphicsCardFile()) GTEST_SKIP() << "this machine may have one";
  const auto renderer = rendererFor({});
  EXPECT_EQ(renderer->kind(), RendererKind::Cpu);
  EXPECT_TRUE(has(renderer->why(), "no graphics card")) << renderer->why();
}

TEST(ShowRenderer, NothingDrawsIfThatIsAskedFor) {
  EXPECT_TRUE(rendererFor({RendererChoice::None})->drawsNothing());
}

TEST(ShowRenderer, CardsMatterWithEglOnly) {
  EXPECT_FALSE(rendererFor({RendererChoice::Cpu})->checkCard(40));
  EXPECT_FALSE(rendererFor({RendererChoice::Gl, GlProviderKind::OsMesa})->checkCard(40));
  const auto why = rendererFor({RendererChoice::Gl, GlProviderKind::Egl})->checkCard(40);
  ASSERT_TRUE(why);
  EXPECT_TRUE(has(why->message, "no graphics card 40") || has(why->message, "no card 40")) << why->message;
}

TEST(ShowRenderer, PicturesHaveASizeThatServes) {
  for (const RendererChoice choice : {RendererChoice::Cpu, RendererChoice::Gl}) {
    const auto renderer = rendererFor({choice});
    EXPECT_FALSE(renderer->checkSize(800, 600));
    EXPECT_TRUE(renderer->checkSize(0, 600));
    EXPECT_TRUE(renderer->checkSize(20'000, 600));
  }
}

}  // namespace
}  // namespace stadion
