#pragma once
/// A draw list as bytes, for the process that draws it.
///
/// Shadow casters that stand still travel only after a change. Everything else travels in every frame: some
/// hundred bytes for each visible object.
///
/// Threads  plain functions; one Draw thread a list.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/state/shared_segment.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stadion::wall_process {

/// The place of a mesh in the segment of meshes (shared_meshes.h). Sent with the first list that shows the
/// mesh.
struct SharedMeshPlace {
  MeshId id = kNoMesh;
  std::uint64_t offset = 0, bytes = 0;
};

/// Changes of the meshes that a process must know before it draws the list.
struct ListNews {
  std::vector<SharedMeshPlace> meshes;
  std::vector<MeshId> gone;  ///< freed by the show, which may use their ids again
};

/// The still casters that the process has, by ring: none yet, or those of this key.
using StillKeys = std::array<std::optional<std::uint64_t>, kShadowRings>;

/// Returns the number of bytes written. Brings `known` up to date.
std::size_t write(const DrawList& list, const ListNews& news, StillKeys& known, SharedSegment& to);

/// Fills `list` and `news`, reusing their memory. Rings without new still casters keep those that the list
/// had. Returns false if the bytes are damaged.
bool read(std::span<const std::byte> bytes, DrawList& list, ListNews& news);

}  // namespace stadion::wall_process
