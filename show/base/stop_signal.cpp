#include "show/base/stop_signal.h"

#include "show/base/raw_terminal.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sys/prctl.h>
#include <unistd.h>

namespace stadion {
namespace {

std::atomic<bool> requested = false;  // set by the handler, which can reach nothing else
std::atomic<int> received = 0;
std::atomic<std::chrono::steady_clock::rep> receivedAt = 0;

/// Programs that stop others may send the same signal to the process and to its group: that is one request.
constexpr std::chrono::steady_clock::duration kOneRequest = std::chrono::milliseconds(100);

extern "C" void requestStop(int signal) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  std::chrono::steady_clock::rep before = 0;
  if (receivedAt.compare_exchange_strong(before, now)) {
    received = signal;
    requested = true;
  } else if (now - before > kOneRequest.count()) {
    giveTerminalBack();
    std::_Exit(128 + signal);
  }
}

}  // namespace

const std::atomic<bool>& catchStopSignals() {
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  return requested;
}

void outliveReaders() {
  std::signal(SIGPIPE, SIG_IGN);
}

void stopWithParent(int parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) std::raise(SIGTERM);  // it died before it could be asked for
}

int stopSignal() {
  return received;
}

std::chrono::steady_clock::duration sinceStopSignal() {
  const std::chrono::steady_clock::duration at(receivedAt);
  return at.count() == 0 ? at : std::chrono::steady_clock::now().time_since_epoch() - at;
}

const char* stopSignalName() {
  return received == SIGINT ? "SIGINT" : "SIGTERM";
}

}  // namespace stadion
