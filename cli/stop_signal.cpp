#include "cli/stop_signal.h"

#include <csignal>
#include <cstdlib>

namespace stadion {
namespace {

std::atomic<bool> requested = false;  // set by the handler, which can reach nothing else
std::atomic<int> received = 0;
std::atomic<std::chrono::steady_clock::rep> receivedAt = 0;

extern "C" void requestStop(int signal) {
  received = signal;
  receivedAt = std::chrono::steady_clock::now().time_since_epoch().count();
  if (requested.exchange(true)) std::_Exit(128 + signal);
}

}  // namespace

const std::atomic<bool>& catchStopSignals() {
  std::signal(SIGINT, requestStop);
  std::signal(SIGTERM, requestStop);
  return requested;
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
