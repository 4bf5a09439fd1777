#pragma once
/// Tangents for normal maps, where the file has none.

#include "engine/asset/importer_program/mesh/geometry.h"
#include "engine/asset/material.h"

#include <vector>

namespace stadion::importer {

/// Gives the corners that a normal map lies on tangents, if they have none: smooth over the triangles that share a
/// vertex, so that few triangles do not look like facets. As in MikkTSpace, which glTF prescribes
/// (Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008, and mikktspace.com), a vertex gets the sum of the
/// tangents of its triangles in its own plane, each of unit length and weighted by the angle at the corner. Triangles
/// whose picture is mirrored do not count with others. Unlike there, vertices are equal only if all of their data
/// are.
/// A corner whose coordinates say nothing keeps none. After makeNormals().
void makeTangents(const std::vector<Material>& materials, Flat& flat);

}  // namespace stadion::importer
