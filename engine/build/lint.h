#pragma once
/// Warnings about a script that is correct but hardly means what it says.

#include "engine/script/document.h"

namespace stadion {

/// Expects a document whose names are resolved. Looks at this file only; files inside and around it may use
/// what seems unused here, so a field or trigger is called unused only if it has no name or the file stands
/// alone
/// (`alone`: no file loads it and it loads none).
void lint(const Document& document, bool alone, Diagnostics& findings);

/// Warns of messages whose stated latency is shorter than a frame: it fixes nothing then.
///
/// Units    `step` is the time of one frame [ns].
void lintLatencies(const Document& document, Nanoseconds step, Diagnostics& findings);

/// Warns of trackers that no device is called: `known` are those of the show's input log, `log` its name.
/// Without a log, of names that look like a slip of the usual ones.
void lintTrackers(const Document& document, const std::vector<std::string>& known, const std::string& log,
                  Diagnostics& findings);

}  // namespace stadion
