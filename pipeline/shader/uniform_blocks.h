#pragma once
/// The uniform blocks of the shaders, in std140 layout, and the functions that fill them.
///
/// Everything that differs per view or per mesh is in such a block, nothing in program uniforms. Coordinates
/// are World axes relative to the draw list's origin, as in the list.

#include "engine/asset/mesh.h"
#include "engine/environment/environment_light.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/gl/gl_program.h"
#include "pipeline/gl/gl_table.h"
#include "pipeline/shader/look.h"

#include <array>
#include <cstdint>

namespace stadion {

using Float4 = std::array<float, 4>;

/// The view's uniform block: camera of one eye.
struct ViewBlock {
  std::array<float, 16> viewProjection;  ///< (4 x 4), column major
  Float4 eye;                            ///< where the eye is [m]; w: the clip z of the far plane, for w = 1
  std::array<Float4, 3> rays;  ///< through the corners (-1,-1), (3,-1), (-1,3) of clip space; for the sky
};

struct LightBlock {
  Float4 position;   ///< relative to origin [m]; w: 1 / range^2, or 0
  Float4 direction;  ///< towards the light, unit; w: 0 directional, 1 point, 2 spot
  Float4 colour;     ///< linear; w unused
  Float4 cone;       ///< spot: cosine of the outer half angle, 1 / (cosine inner - outer); then 1: falls off
};

/// Data that both eyes of a wall share.
struct SceneBlock {
  Float4 zenith, horizon, ground;          ///< linear; w of the first: exposure, in the full look
  Float4 ambient;                          ///< linear; w: 1 / haze distance [1/m], or 0
  Float4 sunDirection;                     ///< towards the sun, unit; w: 1 if there is one
  Float4 sunColour;                        ///< linear, brightest component 1
  std::array<std::int32_t, 4> lightCount;  ///< y: the light that casts shadows, or -1; z: ToneCurve
  std::array<LightBlock, DrawList::kMaxLights> lights;
};

/// Light from all around.
struct EnvironmentBlock {
  /// Factors of 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy in the light of a matt white face with the normal
  /// (x, y, z), turned as the surroundings; w unused.
  std::array<Float4, 9> harmonics;
  Float4 turn;                                       ///< cosine, sine, intensity; w: side of the picture
  std::array<Float4, EnvironmentLight::kMaps> maps;  ///< corner in the texture [texels], side; w unused
  Float4 texel;                                      ///< 1 / width, 1 / height of the texture; z, w unused
};

struct MaterialBlock {
  Float4 baseColour;  ///< linear, alpha
  Float4 emissive;    ///< linear; w: roughness
  Float4 finish;      ///< x: metallic, y: alpha cutoff, z: normal scale, w: occlusion strength
  /// For each map: two rows that give its coordinates. w of the first: 1 if it reads the second ones.
  std::array<Float4, 2 * kMapKinds> places;
};

/// The places of the shadow maps: from World axes relative to the list's origin to the texture.
struct ShadowBlock {
  Float4 right, up;                        ///< the light's axes; w unused
  Float4 towards;                          ///< w: depth per metre
  std::array<Float4, kShadowRings> rings;  ///< offset of texture coordinates and depth; w: their scale
  Float4 lift;                             ///< for each ring: along the surface's normal [m]
};

/// Binding points of the blocks.
enum UniformBinding : std::uint32_t {
  kViewBinding = 0,
  kSceneBinding = 1,
  kMaterialBinding = 2,
  kShadowBinding = 3,
  kEnvironmentBinding = 4
};
/// Binding points of the buffers that indirect draws read (indirect_draws.h). The lower ones are those of layers.
enum StorageBinding : std::uint32_t { kMaterialsBinding = 3, kDrawsBinding = 4 };
/// The texture units of the shadow maps, of light from all around, and of a material's maps by MapKind.
constexpr int kShadowUnit = 1, kEnvironmentUnit = 8;
constexpr std::array<int, kMapKinds> kMapUnits{0, 2, 3, 4, 5};

/// The blocks and textures of all our shaders; a program takes those that it uses.
GlBindings shaderBindings();

/// Copies a matrix to clip coordinates, z in [0, w], into the block, in the context's convention.
void fillViewProjection(const Mat4& viewProjection, ClipDepth clip, ViewBlock& out);
/// False if the eye's matrices are not finite or cannot be inverted: nothing can be drawn then.
bool fillView(const DrawView& eye, ClipDepth clip, ViewBlock& out);
/// In the plain look all colours are in sRGB, as they are stored, instead of linear. Exposure is in them, and the
/// light from all around is the same everywhere. `environment`: null = there is none.
SceneBlock fillScene(const DrawSky& sky, const std::vector<DrawLight>& lights, Look look,
                     std::int32_t shadowed = -1, const EnvironmentLight* environment = nullptr);
/// All but the places in the texture.
EnvironmentBlock fillEnvironment(const EnvironmentRecord& record, const EnvironmentLight& light);
MaterialBlock fillMaterial(const Material& material, Look look);

}  // namespace stadion
