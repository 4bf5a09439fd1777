#pragma once
/// Warnings about a script that is correct but hardly means what it says.

#include "engine/script/document.h"

namespace stadion {

/// Expects a document whose names are resolved. Looks at this file only; files inside and around it may use
/// what seems unused here, so a field or trigger is called unused only if it has no name or the file stands
/// alone
/// (`alone`: no file loads it and it loads none).
void lint(const Document& document, bool alone, Diagnostics& findings);

}  // namespace stadion
