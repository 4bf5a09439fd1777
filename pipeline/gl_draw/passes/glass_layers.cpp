#include "pipeline/gl_draw/passes/glass_layers.h"

#include "pipeline/shader/shaders.h"
#include "pipeline/shader/uniform_blocks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>

namespace stadion {
namespace {

constexpr std::size_t kFragmentBytes = 32;
constexpr std::uint32_t kRoomAtFirst = 1U << 16;  ///< for fragments
/// Texture units of what the blending shader reads; no other shader reads them.
constexpr GLint kHeadsUnit = 3, kNodesUnit = 4, kDepthsUnit = 5;

/// In halves across the longer side; a single pixel stays as it is.
bool halve(const PixelArea& a, PixelArea& first, PixelArea& second) {
  first = second = a;
  if (a.height > 1) {
    first.height = a.height / 2;
    second.y += first.height;
    second.height -= first.height;
    return true;
  }
  if (a.width <= 1) return false;
  first.width = a.width / 2;
  second.x += first.width;
  second.width -= first.width;
  return true;
}

/// At most so many, as high as each other.
std::deque<PixelArea> strips(const PixelArea& a, std::uint64_t count) {
  std::deque<PixelArea> all;
  const auto n =
      static_cast<std::int32_t>(std::clamp<std::uint64_t>(count, 1, static_cast<std::uint64_t>(a.height)));
  for (std::int32_t i = 0; i < n; ++i) {
    const auto row = [&](std::int32_t k) {
      return static_cast<std::int32_t>(std::int64_t{a.height} * k / n);
    };
    all.push_back({a.x, a.y + row(i), a.width, row(i + 1) - row(i)});
  }
  return all;
}

}  // namespace

PixelArea intersection(const PixelArea& a, const PixelArea& b) {
  const std::int32_t x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::min(a.x + a.width, b.x + b.width) - x, std::min(a.y + a.height, b.y + b.height) - y};
}

CoveredAreas::CoveredAreas(std::uint32_t width, std::uint32_t height)
    : width_(static_cast<std::int32_t>(width)), height_(static_cast<std::int32_t>(height)),
      columns_((width_ + kSquare - 1) / kSquare), rows_((height_ + kSquare - 1) / kSquare),
      covered_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

void CoveredAreas::clear() {
  std::ranges::fill(covered_, char{0});
  bounds_ = {};
}

void CoveredAreas::cover(std::span<const std::array<float, 4>, 8> corners) {
  constexpr float kLeast = 1e-6f;  // what is nearer to the eye's plane may be seen anywhere
  std::array<float, 2> lo{1, 1}, hi{-1, -1};
  bool anywhere = false;
  for (const auto& c : corners) {
    if (!(c[3] > kLeast)) {
      anywhere = true;
      break;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      lo[k] = std::min(lo[k], c[k] / c[3]);
      hi[k] = std::max(hi[k], c[k] / c[3]);
    }
  }
  if (anywhere) {
    lo = {-1, -1};
    hi = {1, 1};
  }
  const auto pixel = [](float at, std::int32_t pixels, std::int32_t margin) {
    const float p = (0.5f + 0.5f * std::clamp(at, -1.0f, 1.0f)) * static_cast<float>(pixels);
    return std::clamp(static_cast<std::int32_t>(p) + margin, 0, pixels);
  };
  const std::int32_t x0 = pixel(lo[0], width_, -1), x1 = pixel(hi[0], width_, 2);
  const std::int32_t y0 = pixel(lo[1], height_, -1), y1 = pixel(hi[1], height_, 2);
  if (!(lo[0] <= hi[0] && lo[1] <= hi[1]) || x0 >= x1 || y0 >= y1) return;
  for (std::int32_t row = y0 / kSquare; row <= (y1 - 1) / kSquare; ++row)
    for (std::int32_t column = x0 / kSquare; column <= (x1 - 1) / kSquare; ++column)
      covered_[static_cast<std::size_t>(row * columns_ + column)] = 1;
  const PixelArea& b = bounds_;
  const std::int32_t left = b.empty() ? x0 : std::min(x0, b.x), low = b.empty() ? y0 : std::min(y0, b.y);
  const std::int32_t right = b.empty() ? x1 : std::max(x1, b.x + b.width);
  const std::int32_t high = b.empty() ? y1 : std::max(y1, b.y + b.height);
  bounds_ = {left, low, right - left, high - low};
}

const std::vector<PixelArea>& CoveredAreas::areas() {
  areas_.clear();
  for (std::int32_t row = 0; row < rows_; ++row)
    for (std::int32_t column = 0, end = 0; column < columns_; column = end + 1) {
      const auto isCovered = [&](std::int32_t c) {
        return c < columns_ && covered_[static_cast<std::size_t>(row * columns_ + c)] != 0;
      };
      for (end = column; isCovered(end);) ++end;
      if (end == column) continue;
      const PixelArea run{column * kSquare, row * kSquare, (end - column) * kSquare, kSquare};
      // One that continues an area below it makes that higher.
      const auto same = std::ranges::find_if(areas_, [&](const PixelArea& a) {
        return a.x == run.x && a.width == run.width && a.y + a.height == run.y;
      });
      if (same != areas_.end())
        same->height += kSquare;
      else
        areas_.push_back(run);
    }
  return areas_;
}

bool GlassLayers::isSupported(const GlTable& gl) {
  GLint major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  return major * 10 + minor >= 43 && gl.MemoryBarrier && gl.ClearBufferSubData;
}

Result<std::unique_ptr<GlassLayers>> GlassLayers::create(const GlTable& gl, std::uint32_t width,
                                                         std::uint32_t height, std::uint32_t samples,
                                                         std::uint32_t mostFragments) {
  auto blend =
      GlProgram::build(gl, layerBlendVertexShader(), layerBlendFragmentShader(samples > 1), shaderBindings());
  if (!blend) return blend.error();
  return std::unique_ptr<GlassLayers>(
      new GlassLayers(gl, width, height, samples, mostFragments, std::move(blend.value())));
}

GlassLayers::GlassLayers(const GlTable& gl, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                         std::uint32_t mostFragments, GlProgram blend)
    : gl_(gl), width_(width), height_(height), sampled_(samples > 1), most_(mostFragments),
      blend_(std::move(blend)), count_(gl), head_(gl), node_(gl), headTexture_(gl), nodeTexture_(gl),
      nothing_(gl) {
  const auto uniform = [&](const char* name) { return gl_.GetUniformLocation(blend_.name(), name); };
  row_ = uniform("row");
  heads_ = uniform("heads");
  nodes_ = uniform("nodes");
  depths_ = uniform("depths");
  corners_ = uniform("corners");
  gl_.UseProgram(blend_.name());
  gl_.Uniform1i(row_, static_cast<GLint>(width_));
  gl_.Uniform1i(heads_, kHeadsUnit);
  gl_.Uniform1i(nodes_, kNodesUnit);
  gl_.Uniform1i(depths_, kDepthsUnit);
  gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, count_.name());
  gl_.BufferData(GL_SHADER_STORAGE_BUFFER, sizeof(GLuint), nullptr, GL_DYNAMIC_COPY);
  gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, head_.name());
  const std::size_t pixels = std::size_t{width} * height;
  gl_.BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(pixels * sizeof(GLuint)), nullptr,
                 GL_DYNAMIC_COPY);
  gl_.BindTexture(GL_TEXTURE_BUFFER, headTexture_.name());
  gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_R32UI, head_.name());
  gl_.BindTexture(GL_TEXTURE_BUFFER, 0);
  hold(std::min(kRoomAtFirst, most_));
}

/// So many fragments; what was there is void.
void GlassLayers::hold(std::uint32_t fragments) {
  room_ = fragments;
  gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, node_.name());
  gl_.BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(room_ * kFragmentBytes), nullptr,
                 GL_DYNAMIC_COPY);
  gl_.BindTexture(GL_TEXTURE_BUFFER, nodeTexture_.name());
  gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32UI, node_.name());
  gl_.BindTexture(GL_TEXTURE_BUFFER, 0);
}

void GlassLayers::setSurface(const GlProgram& program, std::uint32_t first, std::uint32_t perInstance) const {
  gl_.Uniform4i(program.layers(), static_cast<GLint>(width_), static_cast<GLint>(room_),
                static_cast<GLint>(first), static_cast<GLint>(perInstance));
  gl_.Uniform4i(program.area(), area_.x, area_.y, area_.x + area_.width, area_.y + area_.height);
}

void GlassLayers::draw(EyeBuffers& buffers, std::uint32_t eye, CoveredAreas& covered,
                       const std::function<void()>& surfaces) {
  calls_ = 0;
  if (covered.bounds().empty()) return;
  const std::vector<PixelArea>& areas = covered.areas();
  const GLuint depths = buffers.depthsSoFar(eye);
  buffers.bind(eye);
  const auto bind = [&](GLint unit, GLenum target, GLuint texture) {
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_.BindTexture(target, texture);
  };
  bind(kHeadsUnit, GL_TEXTURE_BUFFER, headTexture_.name());
  bind(kNodesUnit, GL_TEXTURE_BUFFER, nodeTexture_.name());
  bind(kDepthsUnit, sampled_ ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, depths);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, count_.name());
  gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, head_.name());
  gl_.DepthMask(GL_FALSE);
  // A picture whose fragments do not all find room is drawn in parts: from the start, if that was so before.
  std::deque<PixelArea> left = strips(covered.bounds(), 1 + total_ / std::max(most_ - most_ / 4, 1U));
  total_ = 0;
  while (!left.empty()) {
    const PixelArea area = left.front();
    left.pop_front();
    if (collect(area, surfaces)) {
      total_ += collected_;
      blend(area, areas);
      continue;
    }
    PixelArea first, second;
    if (halve(area, first, second)) {
      left.push_front(second);
      left.push_front(first);
      continue;
    }
    blend(area, areas);  // a single pixel with millions of layers: without those that found no room
  }
  gl_.DepthMask(GL_TRUE);
}

/// False: there is not enough room for so many.
bool GlassLayers::collect(const PixelArea& area, const std::function<void()>& surfaces) {
  constexpr GLbitfield kBuffers =
      GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT;
  for (;;) {
    gl_.MemoryBarrier(kBuffers);  // what was kept before may still be read
    clearHeads(area);
    gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, node_.name());
    // With several samples, Mesa 22.3 scissors a pixel farther on two sides. The surfaces' programs know
    // better.
    area_ = area;
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Scissor(area.x - 1, area.y - 1, area.width + 2, area.height + 2);
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    surfaces();
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.MemoryBarrier(kBuffers);
    gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, count_.name());
    gl_.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof collected_, &collected_);
    if (collected_ <= room_) return true;
    if (room_ >= most_) return false;
    hold(std::min(std::bit_ceil(collected_), most_));
  }
}

void GlassLayers::clearHeads(const PixelArea& area) {
  const GLuint none = 0;
  const auto clear = [&](const GlBuffer& buffer, std::size_t from, std::size_t count) {
    gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
    gl_.ClearBufferSubData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, static_cast<GLintptr>(from * sizeof none),
                           static_cast<GLsizeiptr>(count * sizeof none), GL_RED_INTEGER, GL_UNSIGNED_INT,
                           &none);
  };
  clear(count_, 0, 1);
  clear(head_, static_cast<std::size_t>(area.y) * width_, static_cast<std::size_t>(area.height) * width_);
}

void GlassLayers::blend(const PixelArea& band, const std::vector<PixelArea>& areas) {
  if (collected_ == 0) return;
  gl_.UseProgram(blend_.name());
  gl_.BindVertexArray(nothing_.name());
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_ONE);  // pictures stay opaque
  for (const PixelArea& area : areas) {
    const PixelArea part = intersection(band, area);
    if (part.empty()) continue;
    const auto clip = [](std::int32_t at, std::uint32_t of) {
      return 2 * static_cast<float>(at) / static_cast<float>(of) - 1;
    };
    gl_.Uniform4f(corners_, clip(part.x, width_), clip(part.y, height_), clip(part.x + part.width, width_),
                  clip(part.y + part.height, height_));
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    ++calls_;
  }
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_DEPTH_TEST);
}

}  // namespace stadion
