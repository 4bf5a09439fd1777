#pragma once
/// One model file to one mesh.

#include "engine/asset/importer_program/channel.h"

namespace stadion::importer {

struct ImportedModel {
  Mesh mesh;
  std::string notes;  ///< notes for the author, one a line
};

/// Throws Refusal when the file is missing, broken or beyond the limits.
ImportedModel importModel(const Request& request);

}  // namespace stadion::importer
