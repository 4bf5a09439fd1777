#pragma once
/// A draw list as bytes, for the process that draws it.
///
/// What casts shadows and stands still travels only when it has changed. Everything else travels each time:
/// some hundred bytes for each thing that is seen.
///
/// Threads  plain functions; one Draw thread a list.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/state/shared_segment.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stadion::worker {

/// A mesh that the list is the first to show: where it lies in the meshes' segment (mesh_parcels.h).
struct MeshPlace {
  MeshId id = kNoMesh;
  std::uint64_t offset = 0, bytes = 0;
};

/// What goes with a list.
struct ListNews {
  std::vector<MeshPlace> meshes;
  std::vector<MeshId> gone;  ///< they are not shown any more, and their ids may be given to others
};

/// The still casters that the other side has, by ring: none yet, or those of this key.
using StillKeys = std::array<std::optional<std::uint64_t>, kShadowRings>;

/// Returns how many bytes that took. Brings `known` up to date.
std::size_t write(const DrawList& list, const ListNews& news, StillKeys& known, SharedSegment& to);

/// Fills `list` and `news`, reusing their memory; rings without new still casters keep those that the list
/// had. False if the bytes are not a list.
bool read(std::span<const std::byte> bytes, DrawList& list, ListNews& news);

}  // namespace stadion::worker
