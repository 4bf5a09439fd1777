#pragma once
/// What of a source scene is used, approximated and left out, in words.

#include "engine/asset/importer_program/source/source_scene.h"

namespace stadion::importer {

/// Adds a line for each kind of content. Content that no scene uses counts too: it is in the file.
/// `figure`: a figure is made of it, which plays its clips.
void takeInventory(const SourceScene& scene, bool figure, ModelInventory& inventory);

}  // namespace stadion::importer
