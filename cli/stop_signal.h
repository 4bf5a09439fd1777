#pragma once
/// Ctrl-C (SIGINT) and SIGTERM: the first one asks the run to end, the second one ends the process at once.

#include <atomic>

namespace stadion {

/// From now on the two signals set the flag that is returned. The flag is the process's, as signals are.
const std::atomic<bool>& catchStopSignals();

/// The signal that came, 0 if none did.
int stopSignal();

/// "SIGINT", "SIGTERM".
const char* stopSignalName();

}  // namespace stadion
