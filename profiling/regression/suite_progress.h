#pragma once
/// The finished cases of a suite, so that an interrupted suite continues.
///
///     {"suite": "HEX16"}                       identifies the suite and the program; others start afresh
///     {"case": "kick", "results": [...]}       one line for each finished case
///
/// Threads  plain values, any thread.
/// Errors   invalid lines are skipped: the last one may be incomplete.

#include "profiling/regression/spans/result.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

using DoneCases = std::map<std::string, std::vector<CaseResult>>;  ///< by case

std::string progressHeading(const std::string& identity);
std::string progressLine(const std::string& caseName, const std::vector<CaseResult>& results);
/// Returns nothing if the text begins with another heading. Cases that could not be played are not finished.
DoneCases readProgress(const std::string& text, const std::string& identity);

}  // namespace stadion::regression
