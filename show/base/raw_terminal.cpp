#include "show/base/raw_terminal.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <pthread.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

namespace stadion {
namespace {

/// That end the program without asking; SIGINT and SIGTERM are stop_signal's.
constexpr std::array kEnding{SIGHUP, SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGPIPE};

/// Reached by handlers, which can reach nothing else. Complete before `isTaken` says so.
struct SavedTerminal {
  int file = -1;
  termios before{}, raw{};
  std::array<struct sigaction, kEnding.size()> actions{};  ///< of kEnding, before
  struct sigaction stopAction {};                          ///< of Ctrl-Z, before
} savedTerminal;
std::atomic<bool> isTaken = false;

bool isForeground(int file) {
  return tcgetpgrp(file) == getpgrp();
}

void set(const termios& how) {
  if (isTaken && isForeground(savedTerminal.file)) tcsetattr(savedTerminal.file, TCSANOW, &how);
}

/// The signal's earlier action follows when this returns.
extern "C" void endBySignal(int signal) {
  const int error = errno;
  set(savedTerminal.before);
  for (std::size_t i = 0; i < kEnding.size(); ++i)
    if (kEnding[i] == signal) sigaction(signal, &savedTerminal.actions[i], nullptr);
  raise(signal);
  errno = error;
}

/// Ctrl-Z: the program stops in here until a signal continues it.
extern "C" void standStill(int signal) {
  const int error = errno;
  set(savedTerminal.before);
  struct sigaction mine {};
  sigaction(signal, &savedTerminal.stopAction, &mine);
  sigset_t only, before;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, &before);
  raise(signal);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  sigaction(signal, &mine, nullptr);
  set(savedTerminal.raw);
  errno = error;
}

struct sigaction actionOf(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  return action;
}

/// Signals that are ignored (nohup) stay so.
void handle(int signal, void (*handler)(int), struct sigaction& before) {
  const struct sigaction action = actionOf(handler);
  if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
    sigaction(signal, &action, nullptr);
}

}  // namespace

std::unique_ptr<RawTerminal> RawTerminal::take(int file) {
  if (isTaken || isatty(file) != 1 || !isForeground(file)) return nullptr;
  if (tcgetattr(file, &savedTerminal.before) != 0) return nullptr;
  savedTerminal.file = file;
  savedTerminal.raw = savedTerminal.before;
  savedTerminal.raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  savedTerminal.raw.c_cc[VMIN] = 1;
  savedTerminal.raw.c_cc[VTIME] = 0;
  for (std::size_t i = 0; i < kEnding.size(); ++i) handle(kEnding[i], endBySignal, savedTerminal.actions[i]);
  handle(SIGTSTP, standStill, savedTerminal.stopAction);
  isTaken = true;
  std::atexit(giveTerminalBack);
  std::unique_ptr<RawTerminal> mine(new RawTerminal(file));
  return tcsetattr(file, TCSANOW, &savedTerminal.raw) == 0 ? std::move(mine) : nullptr;
}

RawTerminal::~RawTerminal() {
  giveTerminalBack();
  isTaken = false;
  for (std::size_t i = 0; i < kEnding.size(); ++i) sigaction(kEnding[i], &savedTerminal.actions[i], nullptr);
  sigaction(SIGTSTP, &savedTerminal.stopAction, nullptr);
}

bool RawTerminal::inForeground() const {
  return isForeground(file_);
}

void giveTerminalBack() {
  set(savedTerminal.before);
}

}  // namespace stadion
