#pragma once
/// The lights and cameras of a source scene as those of a mesh.

#include "engine/asset/importer_program/mesh/node_choice.h"
#include "engine/asset/inventory.h"
#include "engine/asset/mesh_file.h"

namespace stadion::importer {

/// Fills mesh.lights and mesh.cameras with those of the chosen nodes, in the order of the file. Each has its
/// node's name, or its own if the node has none. Lights of other kinds than the mesh can have are left out. What lies
/// nowhere or goes beyond the limits is left out, too, and the inventory says so.
void readLightsAndCameras(const SourceScene& scene, const NodeChoice& choice, const MeshLimits& limits,
                          Mesh& mesh, ModelInventory& inventory);

}  // namespace stadion::importer
