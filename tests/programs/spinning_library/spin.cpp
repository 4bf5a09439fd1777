/// Preloaded into a program, it makes SIGUSR1 an endless loop, as of a driver that goes round in circles.

#include <csignal>

namespace {

volatile bool goesOn = true;

void spin(int) {
  while (goesOn) {
  }
}

[[gnu::constructor]] void listen() {
  std::signal(SIGUSR1, spin);
}

}  // namespace
