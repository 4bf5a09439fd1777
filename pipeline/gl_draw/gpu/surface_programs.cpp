#include "pipeline/gl_draw/gpu/surface_programs.h"

#include "pipeline/shader/uniform_blocks.h"

#include <cassert>

namespace stadion {

std::optional<Diagnostic> SurfacePrograms::build() {
  SurfaceTraits common;
  common.look = look_;
  return buildUsual(common, sets_[0]);
}

/// All of the usual ones, or none.
std::optional<Diagnostic> SurfacePrograms::buildUsual(const SurfaceTraits& common, Set& set) const {
  set.common = common;
  for (std::size_t i = SurfaceTraits::kUsual; i-- > 0;) {  // the first one last: it says that all are there
    SurfaceTraits traits = common;
    traits.textured = (i & 1) != 0;
    traits.localLights = (i & 2) != 0;
    traits.writes = (i & 4) != 0 ? SurfaceWrites::Blended : SurfaceWrites::Picture;
    assert(traits.index() == i);
    auto built = compile(traits);
    if (!built) return built.error();
    set.usual[i].emplace(std::move(built.value()));
  }
  return {};
}

void SurfacePrograms::choose(const Common& of) {
  const bool counted = look_ == Look::Plain && of.lights <= kMostCounted;
  SurfaceTraits common;
  common.shadowed = of.shadowed;
  common.hazy = of.hazy;
  common.look = look_;
  common.lights = counted ? static_cast<int>(of.lights) : -1;
  if (look_ == Look::Full) common.surroundings = of.surroundings, common.tones = of.tones;
  const auto which = static_cast<std::size_t>(common.lights + 1);
  Set& set = sets_[std::size_t{of.shadowed} | std::size_t{of.hazy} << 1 | which << 2 |
                   static_cast<std::size_t>(common.surroundings) << 8 |
                   static_cast<std::size_t>(common.tones) << 10];
  if (set.empty())
    if (const auto why = buildUsual(common, set)) problems_.report(why->message);
  chosen_ = set.empty() ? &sets_[0] : &set;
  localLights_ = of.localLights;
}

Result<GlProgram> SurfacePrograms::compile(SurfaceTraits traits) const {
  traits.indirect = indirect_ && traits.writes == SurfaceWrites::Picture;
  return GlProgram::build(gl_, surfaceVertexShader(traits), surfaceFragmentShader(traits), shaderBindings());
}

const GlProgram& SurfacePrograms::programFor(const GlSubmesh& part, SurfaceWrites writes) {
  SurfaceTraits traits;
  traits.textured = part.maps[kBaseMap] != 0;
  traits.localLights = localLights_;
  traits.writes = writes;
  traits.masked = part.masked;
  traits.unlit = part.unlit;
  traits.glowing = part.maps[kEmissiveMap] != 0 && !part.unlit;
  traits.finished = part.maps[kMetallicRoughnessMap] != 0 && !part.unlit;
  traits.bumpy = part.maps[kNormalMap] != 0 && !part.unlit;
  traits.occluded = part.maps[kOcclusionMap] != 0 && !part.unlit;
  traits.tangents = traits.bumpy && part.tangents;
  traits.ownPlaces = part.ownPlaces && traits.pictured();
  return find(traits);
}

const GlProgram& SurfacePrograms::use(const GlSubmesh& part, SurfaceWrites writes) {
  const GlProgram& program = programFor(part, writes);
  calls_.use(program);
  return program;
}

const GlProgram& SurfacePrograms::find(SurfaceTraits traits) {
  const std::size_t i = traits.index();
  if (i < SurfaceTraits::kUsual) return *chosen_->usual[i];
  auto at = chosen_->others.find(i);
  if (at == chosen_->others.end()) {
    const SurfaceTraits& common = chosen_->common;
    traits.look = common.look;
    traits.shadowed = common.shadowed;
    traits.hazy = common.hazy;
    traits.lights = common.lights;
    traits.surroundings = common.surroundings;
    traits.tones = common.tones;
    auto built = compile(traits);
    at = chosen_->others.emplace(i, std::nullopt).first;
    if (built)
      at->second.emplace(std::move(built.value()));
    else
      problems_.report(built.error().message);
    calls_.forgetProgram();
  }
  return at->second ? *at->second : *chosen_->usual[i % SurfaceTraits::kUsual];
}

}  // namespace stadion
