#pragma once
/// One model file to one mesh.

#include "engine/asset/importer_program/source/channel.h"
#include "engine/asset/inventory.h"

namespace stadion::importer {

struct ImportedModel {
  Mesh mesh;
  ModelInventory inventory;
};

/// Throws Refusal when the file is missing, broken or beyond the limits.
ImportedModel importModel(const Request& request);

}  // namespace stadion::importer
