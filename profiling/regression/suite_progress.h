#pragma once
/// What of a suite has been done: so that a suite that was interrupted goes on where it was.
///
///     {"suite": "HEX16"}                       what is played, by whom: of anything else nothing is kept
///     {"case": "kick", "results": [...]}       one line for each case that is complete
///
/// Threads  plain values, any thread.
/// Errors   lines that are none are passed over: the last one may be half written.

#include "profiling/regression/spans/result.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

using DoneCases = std::map<std::string, std::vector<CaseResult>>;  ///< by case

std::string progressHeading(const std::string& identity);
std::string progressLine(const std::string& caseName, const std::vector<CaseResult>& results);
/// Nothing if the text begins with another heading. Cases that could not be played are not done.
DoneCases readProgress(const std::string& text, const std::string& identity);

}  // namespace stadion::regression
