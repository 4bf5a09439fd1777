#pragma once
/// Reads configurations of nDisplay (Unreal Engine): its JSON files (.ndisplay, from version 4.27) and its older
/// text files (.cfg).
///
/// A viewport becomes a wall or projectors by the policy of its projection:
///
///     simple           a wall: the screen that the parameter `screen` names
///     mesh             the same, if `mesh_component` names a screen; meshes are assets of the game engine
///     mpcdi            the region of an MPCDI file, or a PFM file of points with its alpha and beta maps
///     camera, manual, link, easyblend, vioso, domeprojection: named and left out
///
/// Axes there are +X forward, +Y right, +Z up, left-handed; lengths are centimetres in JSON and metres in .cfg.
///
/// Source of the format: Epic's "nDisplay Configuration File Reference" and "Projection Policies in nDisplay".
/// Threads  pure functions.
/// Errors   go to the Diagnostics with the JSON path, or the line. What is not understood is a warning.

#include "engine/hall_formats/hall_builder.h"
#include "engine/hall_formats/neighbour_files.h"

namespace stadion {

std::optional<WallFile> readNdisplayJson(const std::string& text, const std::string& file,
                                         const NeighbourFiles& files, Diagnostics& out);
std::optional<WallFile> readNdisplayCfg(const std::string& text, const std::string& file,
                                        const NeighbourFiles& files, Diagnostics& out);

}  // namespace stadion
