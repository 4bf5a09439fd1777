#pragma once
/// Reads MPCDI files (VESA, Multiple Projection Common Data Interchange, 1.0 and 2.0): projectors with their
/// measured points, lenses and light maps, in a ZIP archive with the file mpcdi.xml; or that XML file alone.
///
///     profile 2d   media on a flat canvas: the canvas of a buffer becomes a screen before the visitor, each
///                  region measured points on it
///     profile 3d   a fixed view of one eye: its picture becomes a screen square to the view
///     profile a3   points of the room: each buffer becomes a mesh screen, each region measured points on it
///     profile sl   the same, or lenses if the file has no points
///
/// Frames   World coordinates of a3 are taken as the standard prefers them: X left, Y up, Z forward; those of sl
///          as the coordinateFrame of a region says. The origin is the middle of the floor, or the eye at the
///          visitor's usual place.
/// Rows     PFM files begin with the lowest row, as netpbm and VESA's sample library have it. If that order
///          mirrors the picture, the other one is used: some programs begin at the top.
/// Shares   of 2d warps grow upwards and are those of the region in its buffer.
/// Light    alpha and beta maps are linear light after their gammaEmbedded.
///
/// Left out, and named: colour look-up tables and primaries, lens distortion maps, other programs' extensions.
/// A Stadion extension (mpcdi_writer.h) gives back the exact hall, unless the standard's part was changed since.
///
/// Threads  pure functions.
/// Errors   go to the Diagnostics with the line in mpcdi.xml. What is not understood is a warning.

#include "engine/hall_formats/hall_builder.h"
#include "engine/hall_formats/neighbour_files.h"

namespace stadion {

inline constexpr std::size_t kMostMpcdiBytes = 512U << 20;

/// Reads the bytes of an archive.
std::optional<WallFile> readMpcdi(const std::string& bytes, const std::string& file, Diagnostics& out);
/// Reads the XML file; its files lie beside it.
std::optional<WallFile> readMpcdiXml(const std::string& xml, const std::string& file,
                                     const NeighbourFiles& files, Diagnostics& out);

}  // namespace stadion
