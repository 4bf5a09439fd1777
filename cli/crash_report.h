#pragma once
/// What a crash of the program says of itself: the signal and where it was, on the standard error. The
/// process then ends as it would have without.

namespace stadion {

/// For signals that nobody else (a sanitizer) takes. Once, before there are threads.
void reportCrashes();

}  // namespace stadion
