#pragma once
/// Which kinds of lights shows have.

#include "engine/asset/mesh.h"

#include <optional>
#include <string_view>

namespace stadion::importer {

/// The kind by the word of glTF; nothing for another kind, such as a light with an area.
inline std::optional<ModelLight::Kind> lightKind(std::string_view word) {
  if (word == "directional") return ModelLight::Kind::Directional;
  if (word == "point") return ModelLight::Kind::Point;
  if (word == "spot") return ModelLight::Kind::Spot;
  return std::nullopt;
}

}  // namespace stadion::importer
