#pragma once
/// Flattens a scene's node tree into one list of triangles, and makes an indexed mesh of the list. The vertices
/// of a figure keep the joints that carry them.

#include "engine/asset/importer_program/mesh/figure_joints.h"
#include "engine/asset/importer_program/mesh/node_choice.h"
#include "engine/asset/importer_program/source/source_scene.h"
#include "engine/asset/mesh_file.h"

#include <vector>

namespace stadion::importer {

struct FlatVertex {
  std::array<float, 3> position{};
  std::array<float, 3> normal{};  ///< zero if it is still to be made
  std::array<float, 2> uv{}, secondUv{};
  std::array<float, 4> tangent{0, 0, 0, 1};  ///< w: side of the bitangent; zero if the file has none
  std::array<std::uint8_t, 4> colour{255, 255, 255, 255};
  VertexJoints joints{};
  std::uint32_t morph = 0;  ///< of a figure: number of what morph targets move, from 1; 0 = it is not moved
};

struct FlatTriangle {
  std::array<std::uint32_t, 3> corner;
  std::uint32_t material;
  bool mirrored = false;  ///< of a figure: its node turns left into right, so its corners are to be turned
};

/// Differences to the vertices with consecutive numbers `FlatVertex::morph`.
struct FlatMorph {
  std::uint32_t weight = 0;  ///< as in Skeleton::weights
  std::uint32_t first = 1;
  std::vector<std::array<float, 3>> positions, normals;  ///< normals: as many, or none
};

struct Flat {
  std::vector<FlatVertex> vertices;
  std::vector<FlatTriangle> triangles;
  std::vector<FlatMorph> morphs;
  bool hasUvs = false, hasSecondUvs = false, hasTangents = false, hasColours = false, hasJoints = false;
};

struct FlattenLimits {
  std::uint32_t nodeDepth;
  MeshLimits mesh;
};

/// The chosen nodes, where the scene puts them; a part in its own coordinates. Throws Refusal when the scene goes beyond
/// the limits.
Flat flatten(const SourceScene& scene, const NodeChoice& choice, const FlattenLimits& limits);

/// Everything where its primitive has it, turned to +Z up and metres, with the joints that carry it.
Flat flattenFigure(const SourceScene& scene, const FigureJoints& joints, const FlattenLimits& limits);

struct DroppedTriangles {
  std::size_t notFinite = 0, degenerate = 0;
};

/// Takes out triangles with a corner that is not finite or that have no area. Slivers between three different
/// corners stay if the surface is closed only with them.
DroppedTriangles dropBadTriangles(Flat& flat);

/// Makes the normals that are missing: smooth, except across edges sharper than 40 degrees.
void makeNormals(Flat& flat);

/// Turns the corners of mirrored triangles. After makeNormals(), which looks at the surface as it is bound.
void turnMirrored(Flat& flat);

/// Joins equal vertices and sorts the triangles into one run per material.
void joinInto(const Flat& flat, Mesh& mesh);

}  // namespace stadion::importer
