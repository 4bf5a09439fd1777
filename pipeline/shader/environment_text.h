#pragma once
/// The parts of the shaders for light from all around, and for the curve of bright light.
///
/// Matt         harmonics of irradiance (engine/environment/environment_light.h), never below 0.
/// Mirrored     two maps of nearby roughnesses, blended; four texels of each. They are looked up between the
///              mirrored direction and the normal: rough surfaces mirror little from near their own plane.
/// Share        how much is mirrored, of GGX with Smith's shadowing and Schlick's Fresnel term: the rational fit
///              of MaterialX (mx_ggx_dir_albedo_analytic). Its mean error is 0.007.
/// Energy       what a rough surface loses at once, it mirrors after several reflections (Fdez-Aguera 2019, "A
///              Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting"); a dielectric's colour
///              gets the rest. So a white surface in surroundings of 1 shows 1.
/// Harmonics    shiny surfaces mirror the harmonics, sharper for smooth ones. At roughness 1 that is exact.
/// Occlusion    dims all of it.

namespace stadion {

extern const char* const kEnvironmentText;  ///< with ENVIRONMENT 1: harmonics alone; 2: with maps
extern const char* const kTonesText;        ///< with TONES: ToneCurve + 1

}  // namespace stadion
