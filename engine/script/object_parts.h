#pragma once
/// Parts of models that a script names: "hall/roof" is the node `roof` in the file of the object `hall`.
///
/// Such a name declares an object of its own. It has the file and the other attributes of `hall` that say how to read
/// and show it, and hangs from `hall`, or from the part in whose path it is named: "hall/roof/lamp" from "hall/roof".
/// The builder leaves it out of `hall`.

#include "engine/script/document.h"

namespace stadion {

/// Declares all parts that references of the document name. Expects that names are not resolved yet.
void declareParts(Document& document);

/// Returns true for a part that stands in the script only by its name.
bool isPartByUse(const Declaration& object);

/// The part of its file that an object shows, as a path of node names; empty: all of it.
std::string partOf(const Declaration& object);

/// The parts of its file that an object does not show, since the script names them.
std::vector<std::string> partsWithout(const Declaration& object);

}  // namespace stadion
