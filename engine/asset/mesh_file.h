#pragma once
/// A mesh as bytes, as the importer program sends it.
///
/// Layout  One fixed head (magic, version, counts), then the arrays one after another; native byte order,
///         since both ends run on one machine and a foreign file fails at the magic.
/// Errors  decode() trusts nothing. It checks counts against limits and against the available bytes, that
///         every index is in range, every number finite, and normals of unit length. It reads no byte beyond
///         the given ones.

#include "engine/asset/mesh.h"
#include "engine/base/diagnostic.h"

#include <memory>
#include <span>

namespace stadion {

/// The most that a mesh may hold.
struct MeshLimits {
  std::uint32_t vertices = 20'000'000;
  std::uint32_t triangles = 20'000'000;
  std::uint32_t materials = 4096;
  std::uint32_t textures = 256;
  std::uint32_t textureSide = 8192;                 ///< [pixels]
  std::uint64_t textureBytes = 512u * 1024 * 1024;  ///< all textures together
  std::uint32_t morphs = 4096;
  std::uint64_t morphedVertices = 50'000'000;  ///< of all morph targets together
  std::uint32_t lights = 4096, cameras = 4096;
  SkeletonLimits skeleton;
};

std::vector<std::uint8_t> encode(const Mesh& mesh);

/// The mesh without bounds, sphere and hash (see finish), or why the bytes are not one.
Result<std::unique_ptr<Mesh>> decode(std::span<const std::uint8_t> bytes, const MeshLimits& limits = {});

}  // namespace stadion
