#include "show/player/show_renderer.h"

#include "pipeline/gl/gl_table.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/loop/show_stages.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/target/graphics_card.h"

#include <algorithm>

namespace stadion {
namespace {

std::uint32_t drawingThreads(std::uint32_t asked) {
  if (asked > 0) return asked;
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, processorsOfThisThread().size()));
}

/// Whether a graphics card makes the provider's pictures.
bool drawsOn(GlProvider& provider) {
  const auto target = provider.create(1, 1);
  if (!target || target.value()->makeCurrent()) return false;
  const bool card = !isSoftware(target.value()->gl());
  target.value()->release();
  return card;
}

}  // namespace

Result<std::unique_ptr<ShowRenderer>> ShowRenderer::open(const RendererSettings& settings) {
  std::unique_ptr<ShowRenderer> renderer(new ShowRenderer);
  renderer->submission_ = settings.submission;
  if (const auto why = renderer->choose(settings)) return *why;
  return Result<std::unique_ptr<ShowRenderer>>(std::move(renderer));
}

std::optional<Diagnostic> ShowRenderer::choose(const RendererSettings& settings) {
  const RendererChoice choice = settings.choice;
  if (choice == RendererChoice::None) return {};
  if (choice != RendererChoice::Cpu) {
    if (settings.gl) return openGl(*settings.gl);
    if (openCard()) return {};
    if (choice == RendererChoice::Gl) return openGl(GlProviderKind::OsMesa);
  }
  kind_ = RendererKind::Cpu;
  threads_ = drawingThreads(settings.threads);
  return {};
}

std::optional<Diagnostic> ShowRenderer::openGl(GlProviderKind gl) {
  auto provider = openGlProvider(gl);
  if (!provider) return provider.error();
  provider_ = std::move(provider.value());
  kind_ = gl == GlProviderKind::Egl ? RendererKind::Egl : RendererKind::OsMesa;
  return {};
}

/// Device files are looked at first: to load a driver takes longer than to find out that there is no card.
bool ShowRenderer::openCard() {
  const auto file = graphicsCardFile();
  if (!file) {
    why_ = "no graphics card: there is no usable render node in /dev";
    return false;
  }
  if (const auto failed = openGl(GlProviderKind::Egl)) {
    why_ = *file + " cannot draw: " + failed->message;
    return false;
  }
  if (drawsOnCard()) {
    why_ = "graphics card " + *file;
    return true;
  }
  provider_.reset();
  onCard_.reset();
  why_ = *file + " has no driver that draws: OpenGL would draw in software";
  return false;
}

bool ShowRenderer::drawsOnCard() {
  if (!onCard_) onCard_ = provider_ && kind_ == RendererKind::Egl && drawsOn(*provider_);
  return *onCard_;
}

std::optional<Diagnostic> ShowRenderer::checkSize(std::uint32_t width, std::uint32_t height) {
  return provider_ ? checkPictureSize(*provider_, width, height) : checkPictureSize(width, height);
}

std::optional<Diagnostic> ShowRenderer::checkCard(std::uint32_t card) {
  if (!provider_) return {};
  const auto target = provider_->createOn(card, 1, 1);
  return target ? std::nullopt : std::optional(target.error());
}

void ShowRenderer::drawFor(ShowParts& parts) {
  parts.provider = provider_.get();
  parts.quality.submission = submission_;
  if (threads_ == 0 || parts.wallProcesses) return;
  if (!pool_) pool_ = std::make_unique<DrawPool>(threads_);
  parts.pool = pool_.get();
}

}  // namespace stadion
