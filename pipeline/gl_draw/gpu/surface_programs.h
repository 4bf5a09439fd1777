#pragma once
/// The programs that draw surfaces, one for each set of features that a surface may have (SurfaceTraits).
///
/// Cost       the usual programs for air without haze and shadows are compiled at the start, the others at
///            their first use.
/// Ownership  owns the GL programs. Threads: the thread on which the context is current.
/// Errors     if a program cannot be built, the nearest usual one is used instead and the problem is reported
///            once.

#include "pipeline/gl/gl_program.h"
#include "pipeline/gl/problem_log.h"
#include "pipeline/gl_draw/gpu/draw_calls.h"
#include "pipeline/gl_draw/gpu/mesh_cache.h"
#include "pipeline/shader/shaders.h"

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <unordered_map>

namespace stadion {

class SurfacePrograms {
public:
  /// `indirect`: what writes the picture is drawn by IndirectDraws.
  SurfacePrograms(const GlTable& gl, Look look, bool indirect, DrawCalls& calls, ProblemLog& problems)
      : gl_(gl), look_(look), indirect_(indirect), calls_(calls), problems_(problems) {}

  /// Builds the usual programs; once, before anything else. Returns why that failed, or nothing.
  std::optional<Diagnostic> build();

  /// Traits that all surfaces of a list share.
  struct Common {
    bool shadowed = false;     ///< a light casts shadows
    bool hazy = false;         ///< there is haze
    bool localLights = false;  ///< there are point or spot lights
    std::size_t lights = 0;
    Surroundings surroundings = Surroundings::None;
    int tones = 0;  ///< as in SurfaceTraits
  };
  /// Chooses the programs for a list.
  void choose(const Common& common);
  /// The program for a part of a mesh. Expects that programs are chosen.
  const GlProgram& programFor(const GlSubmesh& part, SurfaceWrites writes);
  /// Uses that program.
  const GlProgram& use(const GlSubmesh& part, SurfaceWrites writes);

private:
  static constexpr std::size_t kMostCounted = 4;  ///< lights for which there are programs of their own

  /// Programs that differ in the mesh, in local lights and in what they write, by SurfaceTraits::index().
  struct Set {
    SurfaceTraits common;
    std::array<std::optional<GlProgram>, SurfaceTraits::kUsual> usual;
    std::unordered_map<std::size_t, std::optional<GlProgram>> others;  ///< no program: it cannot be built
    bool empty() const { return !usual[0]; }
  };

  std::optional<Diagnostic> buildUsual(const SurfaceTraits& common, Set& set) const;
  const GlProgram& find(SurfaceTraits traits);
  Result<GlProgram> compile(SurfaceTraits traits) const;

  const GlTable& gl_;
  Look look_;
  bool indirect_;
  DrawCalls& calls_;
  ProblemLog& problems_;
  std::map<std::size_t, Set> sets_;  ///< by what they share; 0: clear air without shadows
  Set* chosen_ = nullptr;
  bool localLights_ = false;
};

}  // namespace stadion
