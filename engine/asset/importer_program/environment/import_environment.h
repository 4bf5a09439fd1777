#pragma once
/// Reads a picture of surroundings and makes light of it.

#include "engine/asset/inventory.h"
#include "engine/asset/mesh.h"

#include <span>

namespace stadion::importer {

/// A mesh without triangles that holds the light. `path`: its ending says the format. Errors: Refusal.
Mesh importEnvironment(const std::string& path, std::span<const std::uint8_t> file,
                       ModelInventory& inventory);

}  // namespace stadion::importer
