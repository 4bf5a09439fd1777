#pragma once
/// Properties of a mesh that decide how it may be drawn.

#include "engine/asset/mesh.h"

#include <string>

namespace stadion {

/// Returns true if the triangles enclose a volume: every directed edge has its opposite. Vertices at equal
/// positions count as one, so seams of normals and texture coordinates do no harm. One pass, no memory:
/// compares sums of 64-bit hashes, wrong once in about 2^64 meshes.
bool isClosed(const Mesh& mesh);

/// Returns the reason why drawing the mesh would read or write outside its buffers. Empty if there is none.
std::string drawingFault(const Mesh& mesh);

}  // namespace stadion
