#include "pipeline/shader/environment_text.h"

namespace stadion {

const char* const kEnvironmentText = R"(
#ifdef ENVIRONMENT
layout(std140) uniform Environment {
  vec4 aroundHarmonics[9];
  vec4 aroundTurn;     // cosine, sine, intensity; w: side of the picture
  vec4 aroundMaps[8];  // corner in the texture, side
  vec4 aroundTexel;    // 1 / width, 1 / height of the texture
};
uniform sampler2D environmentMap;

vec3 turned(vec3 d) {
  return vec3(d.x * aroundTurn.x + d.y * aroundTurn.y, d.y * aroundTurn.x - d.x * aroundTurn.y, d.z);
}

// The harmonics in direction d. first, second: factors of the bands.
vec3 harmonicsAt(vec3 d, float first, float second) {
  vec3 f = first * d;
  vec3 sum = aroundHarmonics[0].rgb + aroundHarmonics[1].rgb * f.y + aroundHarmonics[2].rgb * f.z +
             aroundHarmonics[3].rgb * f.x +
             second * (aroundHarmonics[4].rgb * (d.x * d.y) + aroundHarmonics[5].rgb * (d.y * d.z) +
                       aroundHarmonics[6].rgb * (3.0 * d.z * d.z - 1.0) + aroundHarmonics[7].rgb * (d.x * d.z) +
                       aroundHarmonics[8].rgb * (d.x * d.x - d.y * d.y));
  return max(sum, 0.0);
}

// A map in direction d: an octahedral square with texels at the corners of its steps. 1 / 256 inside of its edge no
// texel beyond it counts.
vec3 lookUp(vec2 corner, float side, vec3 d) {
  vec2 p = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
  vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  if (d.z < 0.0) p = folded;
  vec2 place = corner + clamp((p * 0.5 + 0.5) * side, 0.00390625, side - 0.00390625) + 0.5;
  return textureLod(environmentMap, place * aroundTexel.xy, 0.0).rgb;
}

// d: what is mirrored, n: the normal. The rougher, the nearer to the normal is what a surface mirrors most.
vec3 mirroredFrom(vec3 d, vec3 n, float roughness) {
#if ENVIRONMENT == 1
  return harmonicsAt(d, 1.5 - 0.5 * roughness, 2.5 - 1.5 * roughness);
#else
  float level = roughness * 7.0;
  float fine = clamp(floor(level), 0.0, 6.0);
  vec4 sharp = aroundMaps[int(fine)], soft = aroundMaps[int(fine) + 1];
  d = mix(d, n, roughness * roughness * roughness * roughness);
  return mix(lookUp(sharp.xy, sharp.z, d), lookUp(soft.xy, soft.z, d), level - fine) * aroundTurn.z;
#endif
}

// What is mirrored at once, and after several reflections.
void shareOf(vec3 mirror, float scale, float bias, float lost, out vec3 once, out vec3 often) {
  once = mirror * scale + bias;
  vec3 mean = mirror + (1.0 - mirror) / 21.0;
  often = once * mean / (1.0 - lost * mean) * lost;
}

// What a surface that mirrors all light would mirror at once, and the part of it that is white at each colour.
vec2 mirroredShare(float x, float roughness) {
  float y = roughness * roughness;
  vec4 r = vec4(0.1003, 0.9345, 1.0, 1.0) + vec4(-0.6303, -2.323, -1.765, 0.2281) * x +
           vec4(9.748, 2.229, 8.263, 15.94) * y + vec4(-2.038, -3.748, 11.53, -55.83) * (x * y) +
           vec4(29.34, 1.424, 28.96, 13.08) * (x * x) + vec4(-8.245, -0.7684, -7.507, 41.26) * (y * y) +
           vec4(-26.44, 1.436, -36.11, 54.9) * (x * x * y) + vec4(19.99, 0.2913, 15.86, 300.2) * (x * y * y) +
           vec4(-5.448, 0.6286, 33.37, -285.1) * (x * x * y * y);
  return clamp(r.xy / r.zw, 0.0, 1.0);
}

vec3 surrounded(vec3 base, float roughness, float metallic, vec3 n, vec3 v, float nv) {
  vec3 matt = harmonicsAt(turned(n), 1.0, 1.0);
  vec3 mirrored = mirroredFrom(turned(reflect(-v, n)), turned(n), roughness);
  vec2 share = mirroredShare(nv, roughness);
  float scale = share.x, bias = share.y, lost = 1.0 - (scale + bias);
  vec3 once, often, metalOnce, metalOften;
  shareOf(vec3(0.04), scale, bias, lost, once, often);
  shareOf(base, scale, bias, lost, metalOnce, metalOften);
  return matt * (1.0 - (once + often)) * (1.0 - metallic) * base + mirrored * mix(once, metalOnce, metallic) +
         matt * mix(often, metalOften, metallic);
}

vec3 backgroundAt(vec3 d) { return lookUp(vec2(0.0), aroundTurn.w, turned(d)) * aroundTurn.z; }
#endif
)";

const char* const kTonesText = R"(
#ifndef TONES
#define toned softClip
#else
#if TONES == 3
// Khronos PBR Neutral (github.com/KhronosGroup/ToneMapping).
vec3 curved(vec3 c) {
  float x = min(c.r, min(c.g, c.b));
  c -= x < 0.08 ? x - 6.25 * x * x : 0.04;
  float peak = max(c.r, max(c.g, c.b));
  if (peak < 0.76) return c;
  float most = 1.0 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
  float white = 1.0 - 1.0 / (0.15 * (peak - most) + 1.0);
  return mix(c * (most / peak), vec3(most), white);
}
#elif TONES == 4
// Narkowicz 2015, "ACES Filmic Tone Mapping Curve".
vec3 curved(vec3 c) {
  return clamp((c * (2.51 * c + 0.03)) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0);
}
#elif TONES == 2
vec3 curved(vec3 c) { return clamp(c, 0.0, 1.0); }
#else
#define curved softClip
#endif
vec3 toned(vec3 c) { return curved(c * zenith.w); }
#endif
)";

}  // namespace stadion
