#pragma once
/// Ctrl-C (SIGINT) and SIGTERM: the first one asks the run to end, the second one ends the process at once,
/// unless it comes within a tenth of a second and so is most likely the same.

#include <atomic>
#include <chrono>

namespace stadion {

/// From now on the two signals set the flag that is returned. The flag is the process's, as signals are.
const std::atomic<bool>& catchStopSignals();

/// From now on the process survives if its output is no longer read (SIGPIPE).
void outliveReaders();

/// SIGTERM comes when the process that started us dies, too; at once if `parent` is that no more.
void stopWithParent(int parent);

/// The signal that came, 0 if none did.
int stopSignal();

/// How long ago it came; 0 if none did. Any thread.
std::chrono::steady_clock::duration sinceStopSignal();

/// "SIGINT", "SIGTERM".
const char* stopSignalName();

}  // namespace stadion
