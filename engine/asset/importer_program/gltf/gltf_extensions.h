#pragma once
/// The extensions of glTF, and what becomes of them.

#include "engine/asset/inventory.h"

#include <optional>
#include <string_view>

namespace stadion::importer {

struct GltfExtension {
  std::string_view name;
  ContentUse use;
  bool named;  ///< the inventory names the extension itself; else it names what the extension holds
};

/// The extension of this name; nothing if it is not known. A file may require any that is known.
std::optional<GltfExtension> gltfExtension(std::string_view name);

}  // namespace stadion::importer
