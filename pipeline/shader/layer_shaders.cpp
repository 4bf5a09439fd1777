// The shaders that sort and blend stored transparent surfaces (glass_layers.h).

#include "pipeline/shader/shaders.h"

namespace stadion {
namespace {

constexpr const char* kLayerVersion = "#version 430 core\n";

// For each sample: sorts its fragments, four at a time. Greater depths are nearer. Loops are few and short,
// and no array is indexed: a software rasteriser runs every line for eight pixels at once.
constexpr const char* kBlendLayers = R"(
#ifdef SAMPLED
uniform sampler2DMS depths;
#else
uniform sampler2D depths;
#endif
uniform usamplerBuffer heads, nodes;
uniform int row;
out vec4 shown;

// One of the four nearest so far, and one that may have to be sorted in before it.
void settle(inout float nearHere, inout uvec3 here, inout float nearOther, inout uvec3 other) {
  bool first = nearOther > nearHere || (nearOther == nearHere && other.z > here.z);
  float n = first ? nearHere : nearOther;
  uvec3 o = first ? here : other;
  nearHere = first ? nearOther : nearHere;
  here = first ? other : here;
  nearOther = n;
  other = o;
}

vec4 colourOf(uvec3 fragment) { return vec4(unpackHalf2x16(fragment.x), unpackHalf2x16(fragment.y)); }

void blend(uvec3 fragment, inout vec3 sum, inout float left) {
  vec4 c = colourOf(fragment);
  sum += left * c.a * c.rgb;
  left *= 1.0 - c.a;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint head = texelFetch(heads, pixel.y * row + pixel.x).r;
  if (head == 0u) discard;
#ifdef SAMPLED
  vec2 off = gl_SamplePosition - 0.5;
  uint mask = 1u << uint(gl_SampleID);
  float opaque = texelFetch(depths, pixel, gl_SampleID).r;
#else
  vec2 off = vec2(0.0);
  uint mask = 1u;
  float opaque = texelFetch(depths, pixel, 0).r;
#endif
  // The depth test has been passed by one sample at least. What lies on an opaque surface is seen, however
  // its depth was rounded.
  float least = opaque - 2e-6 * opaque;
  vec3 sum = vec3(0.0);
  float left = 1.0;
  float last = 2.0;  // behind this one and its order what comes next lies
  uint lastOrder = 0u;
  const uint kGroups = EXACT_GROUPS;
  uint group = 0u;
  int found = 5;
  while (found > 4 && left > 0.0 && group < kGroups) {
    float n0 = -2.0, n1 = -2.0, n2 = -2.0, n3 = -2.0;
    uvec3 f0 = uvec3(0u), f1 = uvec3(0u), f2 = uvec3(0u), f3 = uvec3(0u);
    found = 0;
    for (uint at = head; at != 0u;) {
      uvec4 a = texelFetch(nodes, int(2u * at - 2u)), b = texelFetch(nodes, int(2u * at - 1u));
      vec3 plane = uintBitsToFloat(a.yzw);
      float n = plane.x + plane.y * off.x + plane.z * off.y;
      if ((b.w & mask) != 0u && n >= least && (n < last || (n == last && b.z < lastOrder))) {
        ++found;
        uvec3 f = b.xyz;
        settle(n0, f0, n, f);
        settle(n1, f1, n, f);
        settle(n2, f2, n, f);
        settle(n3, f3, n, f);
      }
      at = a.x;
    }
    blend(f0, sum, left);
    blend(f1, sum, left);
    blend(f2, sum, left);
    blend(f3, sum, left);
    last = n3;
    lastOrder = f3.z;
    ++group;
  }
  if (found > 4 && left > 0.0) {
    // The rest as one layer. Whole numbers are added: their sum does not depend on the order.
    uvec3 colours = uvec3(0u);
    uint weights = 0u, through = 0u;
    for (uint at = head; at != 0u;) {
      uvec4 a = texelFetch(nodes, int(2u * at - 2u)), b = texelFetch(nodes, int(2u * at - 1u));
      vec3 plane = uintBitsToFloat(a.yzw);
      float n = plane.x + plane.y * off.x + plane.z * off.y;
      if ((b.w & mask) != 0u && n >= least && (n < last || (n == last && b.z < lastOrder))) {
        vec4 c = colourOf(b.xyz);
        colours += uvec3(c.rgb * c.a * 4095.0 + 0.5);
        weights += uint(c.a * 4095.0 + 0.5);
        through += uint(min(-log2(max(1.0 - c.a, 1e-6)) * 4096.0 + 0.5, 131072.0));
      }
      at = a.x;
    }
    float passed = exp2(-float(min(through, 1048576u)) / 4096.0);
    sum += left * (1.0 - passed) * vec3(colours) / float(max(weights, 1u));
    left *= passed;
  }
  shown = vec4(sum, left);
}
)";

// Whole pixels.
constexpr const char* kRectangle = R"(
uniform vec4 corners;  // in clip space: x, y, x, y

void main() {
  gl_Position = vec4((gl_VertexID & 1) == 0 ? corners.x : corners.z, (gl_VertexID & 2) == 0 ? corners.y : corners.w,
                     0.0, 1.0);
}
)";

}  // namespace

std::string layerBlendVertexShader() {
  return std::string(kLayerVersion) + kRectangle;
}

std::string layerBlendFragmentShader(bool sampled) {
  return std::string(kLayerVersion) + (sampled ? "#define SAMPLED\n" : "") + "#define EXACT_GROUPS " +
         std::to_string(kExactLayers / 4) + "u\n" + kBlendLayers;
}

}  // namespace stadion
