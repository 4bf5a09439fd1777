#pragma once
/// Properties of a mesh that decide how it may be drawn.

#include "engine/asset/mesh.h"

#include <string>

namespace stadion {

/// Whether the triangles enclose a volume: every directed edge has its opposite. Vertices at equal positions
/// count as one, so seams of normals and texture coordinates do no harm. One pass, no memory: compares sums
/// of 64-bit hashes, wrong once in about 2^64 meshes.
bool encloses(const Mesh& mesh);

/// What would make drawing the mesh read or write where it must not, or an empty string.
std::string drawingFault(const Mesh& mesh);

}  // namespace stadion
