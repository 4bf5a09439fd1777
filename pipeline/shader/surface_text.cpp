#include "pipeline/shader/surface_text.h"

namespace stadion {

const char* const kSurfaceVertex = R"(
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
out vec3 placed;
out vec3 outward;
out vec4 vertexColour;
#ifdef TANGENTS
layout(location = 8) in vec4 tangent;
out vec4 along;  // the tangent; w: side of the bitangent
#endif

void main() {
#ifdef INDIRECT
  takeMaterial();
#endif
  vec4 p = vec4(position, 1.0);
  placed = vec3(dot(modelX, p), dot(modelY, p), dot(modelZ, p));
  // Normals go by the inverse transpose; up to its length that is the cofactor matrix, whose rows are cross
  // products, with the sign of the determinant.
  vec3 cofactorX = cross(modelY.xyz, modelZ.xyz);
  vec3 cofactorY = cross(modelZ.xyz, modelX.xyz);
  vec3 cofactorZ = cross(modelX.xyz, modelY.xyz);
  float side = dot(modelX.xyz, cofactorX) < 0.0 ? -1.0 : 1.0;
  vec3 n = side * vec3(dot(cofactorX, normal), dot(cofactorY, normal), dot(cofactorZ, normal));
  outward = n * inversesqrt(max(dot(n, n), 1e-30));
  vertexColour = colour;
#ifdef TANGENTS
  vec3 t = vec3(dot(modelX.xyz, tangent.xyz), dot(modelY.xyz, tangent.xyz), dot(modelZ.xyz, tangent.xyz));
  along = vec4(t * inversesqrt(max(dot(t, t), 1e-30)), side * tangent.w);
#endif
#ifdef PICTURES
  placeTexels(uv);
#endif
#ifdef LAYERED
  instance = gl_InstanceID;
#endif
  gl_Position = viewProjection * vec4(placed, 1.0);
}
)";

const char* const kSurfaceFragment = R"(
in vec3 placed;
in vec3 outward;
in vec4 vertexColour;
#ifdef TEXTURED
uniform sampler2D baseTexture;
#endif
#ifdef GLOWING
uniform sampler2D glowTexture;
#endif
#ifdef FINISHED
uniform sampler2D finishTexture;
#endif
#ifdef OCCLUDED
uniform sampler2D occlusionTexture;
#endif

#ifdef BUMPY
uniform sampler2D normalTexture;
#ifdef TANGENTS
in vec4 along;
#endif

// The triangle's own tangent: coordinates depend linearly on places, so differences give it exactly.
vec4 tangentHere(vec3 n) {
  vec3 right = dFdx(placed), up = dFdy(placed);
  vec2 r = dFdx(texelOfNormal), u = dFdy(texelOfNormal);
  float turns = r.x * u.y - u.x * r.y < 0.0 ? -1.0 : 1.0;
  vec3 t = turns * (right * u.y - up * r.y), down = turns * (up * r.x - right * u.x);
  return vec4(t, dot(cross(n, t), down) > 0.0 ? -1.0 : 1.0);
}

// The normal that the map gives, unit, on the front's side.
vec3 bumped(vec3 n) {
  vec4 t = tangentHere(n);
#ifdef TANGENTS
  if (dot(along.xyz, along.xyz) > 0.01) t = vec4(along.xyz, along.w < 0.0 ? -1.0 : 1.0);
#endif
  vec3 x = t.xyz - n * dot(n, t.xyz);
  x *= inversesqrt(max(dot(x, x), 1e-30));
  vec3 m = texture(normalTexture, texelOfNormal).rgb * 2.0 - 1.0;
  vec3 bent = (x * m.x + cross(n, x) * (t.w * m.y)) * finish.z + n * m.z;
  float squared = dot(bent, bent);
  return squared > 1e-12 ? bent * inversesqrt(squared) : n;
}
#endif

vec3 ambientFrom(vec3 n) { return ambient.rgb * mix(0.3 + ground.rgb, vec3(1.0), 0.5 + 0.5 * n.z); }

#ifdef SHADOWED
layout(std140) uniform Shadow {
  vec4 shadowRight;
  vec4 shadowUp;
  vec4 shadowTowards;
  vec4 shadowRings[4];
  vec4 shadowLift;
};
uniform sampler2DShadow shadowMap;

// How far p lies from the middle of a ring's quarter of the map; the quarter ends at 0.25.
float outside(vec2 p, vec4 ring, vec2 middle) {
  vec2 away = abs(p * ring.w + ring.xy - middle);
  return max(away.x, away.y);
}

// The part of the light that arrives.
float lightArriving(vec3 n) {
  vec3 s = vec3(dot(shadowRight.xyz, placed), dot(shadowUp.xyz, placed), dot(shadowTowards.xyz, placed));
  vec4 ring = shadowRings[3];
  float lift = shadowLift.w;
  float edge = outside(s.xy, ring, vec2(0.75, 0.75));
  if (outside(s.xy, shadowRings[2], vec2(0.25, 0.75)) < 0.245) { ring = shadowRings[2]; lift = shadowLift.z; }
  if (outside(s.xy, shadowRings[1], vec2(0.75, 0.25)) < 0.245) { ring = shadowRings[1]; lift = shadowLift.y; }
  if (outside(s.xy, shadowRings[0], vec2(0.25, 0.25)) < 0.245) { ring = shadowRings[0]; lift = shadowLift.x; }
  s += lift * vec3(dot(shadowRight.xyz, n), dot(shadowUp.xyz, n), dot(shadowTowards.xyz, n));
  vec2 at = s.xy * ring.w + ring.xy;
  float depth = s.z * shadowTowards.w + ring.z;
  const vec2 o = vec2(0.75, -0.75) / 2048.0;  // of a texel, so that the edge is some three texels wide
  float lit = textureLod(shadowMap, vec3(at + o.xx, depth), 0.0) + textureLod(shadowMap, vec3(at + o.xy, depth), 0.0) +
              textureLod(shadowMap, vec3(at + o.yx, depth), 0.0) + textureLod(shadowMap, vec3(at + o.yy, depth), 0.0);
  return mix(0.25 * lit, 1.0, clamp((edge - 0.22) * 40.0, 0.0, 1.0));
}
#endif

float fifth(float x) {
  float squared = x * x;
  return squared * squared * x;
}

void main() {
#ifdef LAYERED
  vec3 plane = depthPlane();
#endif
  vec4 base = baseColour * vertexColour;
#ifdef TEXTURED
  base *= texture(baseTexture, texelOfBase);
#endif
  vec3 emitted = emissive.rgb;
#ifdef GLOWING
  emitted *= texture(glowTexture, texelOfGlow).rgb;
#endif
#ifdef FINISHED
  vec4 finishHere = texture(finishTexture, texelOfFinish);
#endif
#ifdef OCCLUDED
  float arrives = 1.0 + finish.w * (texture(occlusionTexture, texelOfOcclusion).r - 1.0);
#endif
#ifdef BUMPY
  vec3 n = bumped(outward * inversesqrt(max(dot(outward, outward), 1e-30)));
#endif
#ifdef MASKED
  if (base.a < finish.y) discard;  // after all derivatives are taken
#endif

  vec3 away = eye.xyz - placed;
  float distanceSquared = max(dot(away, away), 1e-12);
  float perDistance = inversesqrt(distanceSquared);
  vec3 v = away * perDistance;
#ifdef UNLIT
  vec3 light = base.rgb;
#else
  float roughness = emissive.w;
  float metallic = finish.x;
#ifdef FINISHED
  roughness = max(roughness * finishHere.g, 0.08);
  metallic *= finishHere.b;
#endif
  vec3 diffuse = base.rgb * (1.0 - metallic);
  vec3 mirror = mix(vec3(0.04), base.rgb, metallic);

#ifndef BUMPY
  vec3 n = outward * inversesqrt(max(dot(outward, outward), 1e-30));
#endif
  if (!gl_FrontFacing) n = -n;
  float nv = max(dot(n, v), 1e-3);

#ifdef ENVIRONMENT
  vec3 light = surrounded(base.rgb, roughness, metallic, n, v, nv);
#ifdef OCCLUDED
  light *= arrives;
#endif
  light += emitted;
#else
  // A dielectric seen square on shows its diffuse colour alone; towards grazing it mirrors the surroundings.
  float grazing = fifth(1.0 - nv) * (1.0 - roughness) * (1.0 - roughness);
#ifdef OCCLUDED
  vec3 light = emitted + arrives * (diffuse * ambientFrom(n) +
               (mirror * metallic + (1.0 - mirror) * grazing) * ambientFrom(reflect(-v, n)));
#else
  vec3 light = emitted + diffuse * ambientFrom(n) +
               (mirror * metallic + (1.0 - mirror) * grazing) * ambientFrom(reflect(-v, n));
#endif
#endif

  float spread = roughness * roughness;
  float spreadSquared = spread * spread;
  float k = 0.5 * spread;
#ifdef SHADOWED
  float arriving = lightArriving(n);  // not in the loop: its lines are run whatever the branches say
#endif
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
    float nl = dot(n, l);
    if (nl > 0.0) {
#ifdef SHADOWED
      strength *= i == lightCount.y ? arriving : 1.0;
#endif
      vec3 h = l + v;
      h *= inversesqrt(max(dot(h, h), 1e-12));
      float nh = clamp(dot(n, h), 0.0, 1.0);
      float lobe = nh * nh * (spreadSquared - 1.0) + 1.0;
      float shadowing = (nl * (1.0 - k) + k) * (nv * (1.0 - k) + k);
      float highlight = 0.25 * spreadSquared / (lobe * lobe * shadowing);
      vec3 fresnel = mirror + (1.0 - mirror) * fifth(1.0 - clamp(dot(l, h), 0.0, 1.0));
      light += (diffuse + highlight * fresnel) * lights[i].colour.rgb * (strength * nl);
    }
  }

#endif
#ifdef HAZY
  vec3 behind = air(-v);
#ifdef UNLIT
  behind = toned(behind);
#endif
  light = mix(behind, light, exp2(-1.442695 * distanceSquared * perDistance * ambient.w));
#endif
#ifndef UNLIT
  light = toned(light);
#endif
#if defined(LAYERED)
  keep(vec4(light, clamp(base.a, 0.0, 1.0)), plane);
#elif defined(BLENDED)
  shown = vec4(light, clamp(base.a, 0.0, 1.0));
#else
  shown = encoded(light);
#endif
}
)";

}  // namespace stadion
