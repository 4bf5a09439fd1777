#include "pipeline/shader/shaders.h"

#include "pipeline/shader/environment_text.h"
#include "pipeline/shader/surface_text.h"

namespace stadion {
namespace {

constexpr const char* kVersion = "#version 330 core\n";
constexpr const char* kStorageVersion = "#version 430 core\n";  ///< with buffers that shaders write

constexpr const char* kDrawVersion =  // with the number of a draw in its call
    "#version 430 core\n#extension GL_ARB_shader_draw_parameters : require\n";

// The same blocks as uniform_blocks.h.
constexpr const char* kBlocks = R"(
layout(std140) uniform View {
  mat4 viewProjection;
  vec4 eye;
  vec4 rays[3];
};
struct Light {
  vec4 position;   // w: 1 / range^2
  vec4 direction;  // towards the light; w: kind
  vec4 colour;
  vec4 cone;       // z: 1 falls off with the square of the distance
};
layout(std140) uniform Scene {
  vec4 zenith;
  vec4 horizon;
  vec4 ground;
  vec4 ambient;  // w: 1 / haze distance
  vec4 sunDirection;
  vec4 sunColour;
  ivec4 lightCount;
  Light lights[16];
};

// The sun's glow in the air.
vec3 glow(vec3 d) {
  float off = max(1.0 - dot(d, sunDirection.xyz), 0.0);  // half the square of the angle
  float near = 1.0 / (1.0 + 900.0 * off);
  return sunColour.rgb * (0.3 * near * near + 0.06 / (1.0 + 18.0 * off)) * sunDirection.w;
}

// Air without end, seen in direction d.
vec3 air(vec3 d) {
  float low = (1.0 - max(d.z, 0.0)) * (1.0 - max(d.z, 0.0));
  return mix(zenith.rgb, horizon.rgb, low * low) + glow(d);
}

// Leaves 0 .. 0.8 alone and bends what is brighter towards 1, with a continuous slope.
vec3 softClip(vec3 c) {
  vec3 over = max(c - 0.8, 0.0) * 5.0;
  return min(c, 0.8) + 0.2 * over / (1.0 + over);
}

vec4 encoded(vec3 c) {  // IEC 61966-2-1
  vec3 bent = 1.055 * pow(max(c, 0.0031308), vec3(1.0 / 2.4)) - 0.055;
  return vec4(mix(12.92 * max(c, 0.0), bent, greaterThan(c, vec3(0.0031308))), 1.0);
}
)";

// Where a surface's maps are read. Without OWN_PLACES all have the same coordinates.
constexpr const char* kTexels = R"(
#ifdef OWN_PLACES
IO vec2 texelOfBase;
IO vec2 texelOfGlow;
IO vec2 texelOfFinish;
IO vec2 texelOfNormal;
IO vec2 texelOfOcclusion;
#elif defined(PICTURES)
IO vec2 texel;
#define texelOfBase texel
#define texelOfGlow texel
#define texelOfFinish texel
#define texelOfNormal texel
#define texelOfOcclusion texel
#endif
)";

constexpr const char* kPlaceTexels = R"(
#ifdef OWN_PLACES
layout(location = 7) in vec2 secondUv;

vec2 placedBy(vec4 u, vec4 v, vec2 first) {
  vec3 from = vec3(u.w > 0.5 ? secondUv : first, 1.0);
  return vec2(dot(u.xyz, from), dot(v.xyz, from));
}
void placeTexels(vec2 first) {
  texelOfBase = placedBy(PLACES[0], PLACES[1], first);
  texelOfGlow = placedBy(PLACES[2], PLACES[3], first);
  texelOfFinish = placedBy(PLACES[4], PLACES[5], first);
  texelOfNormal = placedBy(PLACES[6], PLACES[7], first);
  texelOfOcclusion = placedBy(PLACES[8], PLACES[9], first);
}
#elif defined(PICTURES)
void placeTexels(vec2 first) { texel = first; }
#endif
)";

// Stores transparent surfaces: a list of fragments for each pixel (glass_layers.h).
constexpr const char* kKeepFragment = R"(
#ifdef LAYERED
layout(early_fragment_tests) in;
layout(std430, binding = 0) buffer FragmentCount { uint fragmentCount; };
layout(std430, binding = 1) buffer FragmentHeads { uint fragmentHead[]; };
layout(std430, binding = 2) writeonly buffer Fragments { uvec4 fragment[]; };
uniform ivec4 layers;  // pixels in a row, room for fragments, this call's first triangle, triangles an instance
uniform ivec4 area;    // that is drawn: from x, y to x, y
flat in int instance;

// Derivatives are taken before anything diverges.
vec3 depthPlane() { return vec3(gl_FragCoord.z, dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z)); }

void keep(vec4 colour, vec3 plane) {
  ivec2 at = ivec2(gl_FragCoord.xy);
  if (!(colour.a > 0.0) || any(lessThan(at, area.xy)) || any(greaterThanEqual(at, area.zw))) return;
  uint place = atomicAdd(fragmentCount, 1u);
  if (place >= uint(layers.y)) return;
  uint next = atomicExchange(fragmentHead[at.y * layers.x + at.x], place + 1u);
  fragment[2u * place] = uvec4(next, floatBitsToUint(plane));
  uint order = uint(layers.z) + uint(instance) * uint(layers.w) + uint(gl_PrimitiveID);
  fragment[2u * place + 1u] =
      uvec4(packHalf2x16(colour.rg), packHalf2x16(colour.ba), order, uint(gl_SampleMaskIn[0]));
}
#else
out vec4 shown;
#endif
)";

constexpr const char* kMaterial = R"(
layout(std140) uniform Material {
  vec4 baseColour;
  vec4 emissive;  // w: roughness
  vec4 finish;    // x: metallic, y: alpha cutoff, z: normal scale, w: occlusion strength
  vec4 places[10];
};
#define PLACES places
)";

// The material of a draw of many, for its vertices: the same for all of them.
constexpr const char* kDrawMaterialVertex = R"(
struct MaterialOfDraw {
  vec4 baseColour;
  vec4 emissive;
  vec4 finish;
  vec4 places[10];
};
layout(std430, binding = 3) readonly buffer Materials { MaterialOfDraw materials[]; };
layout(std430, binding = 4) readonly buffer Draws { uint draws[]; };  // six a draw; the last one is its material
uniform int firstDraw;  // of this call
flat out vec4 baseColour;
flat out vec4 emissive;
flat out vec4 finish;

uint which;
#define PLACES materials[which].places

void takeMaterial() {
  which = draws[6 * (firstDraw + gl_DrawIDARB) + 5];
  baseColour = materials[which].baseColour;
  emissive = materials[which].emissive;
  finish = materials[which].finish;
}
)";

constexpr const char* kDrawMaterialFragment = R"(
flat in vec4 baseColour;
flat in vec4 emissive;
flat in vec4 finish;
)";

constexpr const char* kPlainVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
layout(location = 4) in vec4 modelX;  // the model matrix, by rows
layout(location = 5) in vec4 modelY;
layout(location = 6) in vec4 modelZ;

#ifdef LAYERED
flat out int instance;
#endif
out vec4 shade;
#ifdef HAZY
out float clearness;
#endif

void main() {
#ifdef INDIRECT
  takeMaterial();
#endif
  vec4 p = vec4(position, 1.0);
  vec3 placed = vec3(dot(modelX, p), dot(modelY, p), dot(modelZ, p));
  vec3 cofactorX = cross(modelY.xyz, modelZ.xyz);
  vec3 cofactorY = cross(modelZ.xyz, modelX.xyz);
  vec3 cofactorZ = cross(modelX.xyz, modelY.xyz);
  float side = dot(modelX.xyz, cofactorX) < 0.0 ? -1.0 : 1.0;
  vec3 n = side * vec3(dot(cofactorX, normal), dot(cofactorY, normal), dot(cofactorZ, normal));
  n *= inversesqrt(max(dot(n, n), 1e-30));
  vec3 light = ambient.rgb;
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 l = lights[i].direction.xyz;
    float strength = 1.0;
#ifdef LOCAL_LIGHTS
    if (lights[i].direction.w > 0.5) {
      vec3 to = lights[i].position.xyz - placed;
      float squared = max(dot(to, to), 1e-12);
      to *= inversesqrt(squared);
      float fading = max(1.0 - squared * lights[i].position.w, 0.0);
      strength = fading * fading;
      if (lights[i].cone.z > 0.5) strength /= max(squared, 0.01);
      if (lights[i].direction.w > 1.5) {
        float inside = clamp((dot(to, l) - lights[i].cone.x) * lights[i].cone.y, 0.0, 1.0);
        strength *= inside * inside * (3.0 - 2.0 * inside);
      }
      l = to;
    }
#endif
    light += lights[i].colour.rgb * (strength * max(dot(n, l), 0.0));
  }
#if defined(UNLIT)
  shade = vec4(min(baseColour.rgb * colour.rgb, 1.0), baseColour.a * colour.a);
#elif defined(GLOWING)
  shade = vec4(min(baseColour.rgb * colour.rgb * light, 1.0), baseColour.a * colour.a);
#else
  shade = vec4(min(emissive.rgb + baseColour.rgb * colour.rgb * light, 1.0), baseColour.a * colour.a);
#endif
#ifdef PICTURES
  placeTexels(uv);
#endif
#ifdef HAZY
  clearness = exp2(-1.442695 * distance(eye.xyz, placed) * ambient.w);
#endif
#ifdef LAYERED
  instance = gl_InstanceID;
#endif
  gl_Position = viewProjection * vec4(placed, 1.0);
}
)";

constexpr const char* kPlainFragment = R"(
in vec4 shade;
#ifdef TEXTURED
uniform sampler2D baseTexture;
#endif
#ifdef GLOWING
uniform sampler2D glowTexture;
#endif
#ifdef HAZY
in float clearness;
#endif

void main() {
#ifdef LAYERED
  vec3 plane = depthPlane();
#endif
  vec4 c = shade;
#ifdef TEXTURED
  c *= texture(baseTexture, texelOfBase);
#endif
#ifdef GLOWING
  c.rgb = min(c.rgb + emissive.rgb * texture(glowTexture, texelOfGlow).rgb, 1.0);
#endif
#ifdef MASKED
  if (c.a < finish.y) discard;
#endif
#ifdef HAZY
  c.rgb = mix(horizon.rgb, c.rgb, clearness);
#endif
#if defined(LAYERED)
  keep(vec4(c.rgb, clamp(c.a, 0.0, 1.0)), plane);
#elif defined(BLENDED)
  shown = vec4(c.rgb, clamp(c.a, 0.0, 1.0));
#else
  shown = vec4(c.rgb, 1.0);
#endif
}
)";

constexpr const char* kPlainSkyFragment = R"(
in vec3 ray;
out vec4 shown;

void main() {
  vec3 d = normalize(ray);
  float low = (1.0 - max(d.z, 0.0)) * (1.0 - max(d.z, 0.0));
  vec3 above = mix(zenith.rgb, horizon.rgb, low * low);
  shown = vec4(d.z >= 0.0 ? above : mix(horizon.rgb, ground.rgb, exp2(0.03 / min(d.z, -1e-4))), 1.0);
}
)";

constexpr const char* kShadowVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 colour;
layout(location = 4) in vec4 modelX;
layout(location = 5) in vec4 modelY;
layout(location = 6) in vec4 modelZ;

#ifdef MASKED
out float alpha;
#endif

void main() {
#ifdef MASKED
  alpha = baseColour.a * colour.a;
#endif
#ifdef PICTURES
  placeTexels(uv);
#endif
  vec4 p = vec4(position, 1.0);
  gl_Position = viewProjection * vec4(dot(modelX, p), dot(modelY, p), dot(modelZ, p), 1.0);
}
)";

constexpr const char* kShadowFragment = R"(
#ifdef MASKED
in float alpha;
#endif
#ifdef TEXTURED
uniform sampler2D baseTexture;
#endif

void main() {
#ifdef MASKED
  float a = alpha;
#ifdef TEXTURED
  a *= texture(baseTexture, texelOfBase).a;
#endif
  if (a < finish.y) discard;
#endif
}
)";

constexpr const char* kSkyVertex = R"(
out vec3 ray;

void main() {
  ray = rays[gl_VertexID].xyz;
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, eye.w, 1.0);
}
)";

constexpr const char* kSkyFragment = R"(
in vec3 ray;
out vec4 shown;

void main() {
  vec3 d = normalize(ray);
  vec3 c;
#ifdef PICTURED
  c = backgroundAt(d);
#else
  if (d.z >= 0.0) {
    float off = max(1.0 - dot(d, sunDirection.xyz), 0.0);
    c = air(d) + sunColour.rgb * (3.0 * sunDirection.w * (1.0 - smoothstep(6.0e-5, 9.0e-5, off)));
  } else {
    // An endless plain in thin haze: near the horizon one looks through ever more of it.
    c = mix(air(d), ground.rgb, exp2(0.03 / min(d.z, -1e-4)));
  }
#endif
  shown = encoded(toned(c));
}
)";

std::string definitions(const SurfaceTraits& traits) {
  std::string text;
  if (traits.textured) text += "#define TEXTURED\n";
  if (traits.shadowed) text += "#define SHADOWED\n";
  if (traits.hazy) text += "#define HAZY\n";
  if (traits.localLights) text += "#define LOCAL_LIGHTS\n";
  if (traits.writes == SurfaceWrites::Blended) text += "#define BLENDED\n";
  if (traits.writes == SurfaceWrites::Layers) text += "#define LAYERED\n";
  if (traits.masked) text += "#define MASKED\n";
  if (traits.glowing) text += "#define GLOWING\n";
  if (traits.finished) text += "#define FINISHED\n";
  if (traits.bumpy) text += "#define BUMPY\n";
  if (traits.occluded) text += "#define OCCLUDED\n";
  if (traits.bumpy && traits.tangents) text += "#define TANGENTS\n";
  if (traits.unlit) text += "#define UNLIT\n";
  if (traits.pictured()) text += "#define PICTURES\n";
  if (traits.pictured() && traits.ownPlaces) text += "#define OWN_PLACES\n";
  if (traits.indirect) text += "#define INDIRECT\n";
  if (traits.surroundings != Surroundings::None)
    text += "#define ENVIRONMENT " + std::to_string(static_cast<int>(traits.surroundings)) + "\n";
  if (traits.tones > 0) text += "#define TONES " + std::to_string(traits.tones) + "\n";
  text += "#define LIGHTS " +
          (traits.lights < 0 ? std::string("lightCount.x") : std::to_string(traits.lights)) + "\n";
  return text;
}

const char* versionOf(const SurfaceTraits& traits) {
  if (traits.indirect) return kDrawVersion;
  return traits.writes == SurfaceWrites::Layers ? kStorageVersion : kVersion;
}

}  // namespace

std::string surfaceVertexShader(const SurfaceTraits& traits) {
  const bool plain = traits.look == Look::Plain, reads = plain || traits.ownPlaces;
  const char* material = traits.indirect ? kDrawMaterialVertex : reads ? kMaterial : "";
  return versionOf(traits) + definitions(traits) + "#define IO out\n" + kBlocks + material + kTexels +
         kPlaceTexels + (plain ? kPlainVertex : kSurfaceVertex);
}

std::string surfaceFragmentShader(const SurfaceTraits& traits) {
  return versionOf(traits) + definitions(traits) + "#define IO in\n" + kBlocks +
         (traits.indirect ? kDrawMaterialFragment : kMaterial) + kKeepFragment + kTexels +
         (traits.look == Look::Plain ? std::string(kPlainFragment)
                                     : std::string(kTonesText) + kEnvironmentText + kSurfaceFragment);
}

std::string shadowVertexShader(const SurfaceTraits& traits) {
  return kVersion + definitions(traits) + "#define IO out\n" + kBlocks + kMaterial + kTexels + kPlaceTexels +
         kShadowVertex;
}

std::string shadowFragmentShader(const SurfaceTraits& traits) {
  return kVersion + definitions(traits) + "#define IO in\n" + kMaterial + kTexels + kShadowFragment;
}

std::string skyVertexShader() {
  return std::string(kVersion) + kBlocks + kSkyVertex;
}

std::string skyFragmentShader(Look look, int tones, bool pictured) {
  if (look == Look::Plain) return std::string(kVersion) + kBlocks + kPlainSkyFragment;
  std::string text = kVersion;
  if (tones > 0) text += "#define TONES " + std::to_string(tones) + "\n";
  if (pictured) text += "#define ENVIRONMENT 2\n#define PICTURED\n";
  return text + kBlocks + kTonesText + kEnvironmentText + kSkyFragment;
}

}  // namespace stadion
