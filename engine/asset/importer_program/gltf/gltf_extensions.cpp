#include "engine/asset/importer_program/gltf/gltf_extensions.h"

#include <algorithm>

namespace stadion::importer {
namespace {

constexpr GltfExtension kExtensions[]{
    {"EXT_meshopt_compression", ContentUse::Used, true},
    {"EXT_texture_webp", ContentUse::Used, true},
    {"KHR_draco_mesh_compression", ContentUse::Used, true},
    {"KHR_materials_emissive_strength", ContentUse::Used, true},
    {"KHR_mesh_quantization", ContentUse::Used, true},
    {"KHR_texture_transform", ContentUse::Used, false},
    {"KHR_materials_unlit", ContentUse::Used, false},
    {"KHR_lights_punctual", ContentUse::Used, false},
    {"KHR_materials_pbrSpecularGlossiness", ContentUse::Approximated, false},
    {"KHR_materials_anisotropy", ContentUse::LeftOut, true},
    {"KHR_materials_clearcoat", ContentUse::Approximated, false},
    {"KHR_materials_dispersion", ContentUse::LeftOut, true},
    {"KHR_materials_ior", ContentUse::LeftOut, true},
    {"KHR_materials_iridescence", ContentUse::LeftOut, true},
    {"KHR_materials_sheen", ContentUse::LeftOut, true},
    {"KHR_materials_specular", ContentUse::LeftOut, true},
    {"KHR_materials_transmission", ContentUse::Approximated, false},
    {"KHR_materials_variants", ContentUse::LeftOut, true},
    {"KHR_materials_volume", ContentUse::LeftOut, true},
    {"KHR_animation_pointer", ContentUse::LeftOut, true},
    {"KHR_xmp_json_ld", ContentUse::LeftOut, true},
};

}  // namespace

std::optional<GltfExtension> gltfExtension(std::string_view name) {
  const auto at = std::ranges::find(kExtensions, name, &GltfExtension::name);
  return at == std::end(kExtensions) ? std::nullopt : std::optional(*at);
}

}  // namespace stadion::importer
