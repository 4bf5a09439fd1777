#pragma once
/// The files that a show's scripts name.

#include "engine/asset/roots.h"
#include "show/output/output_names.h"

#include <span>
#include <string>
#include <vector>

namespace stadion {

class NodeRegistry;

/// Adds every file that the show's script and its sub-scenes name, called by the place that names it
/// ("part.evs:3:20"), and those of `suspects` that a model among these names in turn, called by the model.
/// What cannot be read names nothing: a run tells what is wrong with it.
void addAssetsOf(const std::string& script, const AssetRoots& roots, const NodeRegistry& types,
                 std::span<const std::string> suspects, std::vector<NamedFile>& files);

}  // namespace stadion
