#pragma once
/// No output may be written over another one, or over anything that a show is played from: the same for every
/// command.

#include "show/output/output_names.h"

#include <span>

namespace stadion {

struct ShowOptions;

/// Says which outputs among `named` are the same file as another of them (refuseSameFiles), or one of a
/// show's: script, walls, log; what its scripts name, those of sub-scenes too; what models name in turn, such
/// as materials and pictures. Scripts are read only if one of the outputs is there.
void refuseOverwriting(std::span<const ShowOptions> shows, std::span<const NamedFile> named,
                       Diagnostics& findings);

}  // namespace stadion
