#include "cli/stop_signal.h"

#include <csignal>
#include <cstdlib>

namespace stadion {
namespace {

std::atomic<bool> requested = false;  // set by the handler, which can reach nothing else
std::atomic<int> received = 0;

extern "C" void requestStop(int signal) {
  received = signal;
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

const char* stopSignalName() {
  return received == SIGINT ? "SIGINT" : "SIGTERM";
}

}  // namespace stadion
