#pragma once
/// How a declaration wants its model imported.

#include "engine/asset/format.h"
#include "engine/script/document.h"

namespace stadion {

/// Expects a type with Trait::Model, Trait::Figure or Trait::Surroundings.
ImportOptions importOptionsOf(const Declaration& d);

/// Where to point at if the model cannot be loaded: at the name of a part, else at the file.
Attr blamedFor(const Declaration& d);

}  // namespace stadion
