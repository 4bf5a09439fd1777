#include "cli/crash_report.h"

#include <csignal>
#include <execinfo.h>
#include <string_view>
#include <unistd.h>

namespace stadion {
namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
constexpr int kFrames = 64;

void say(std::string_view words) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
}

std::string_view nameOf(int signal) {
  switch (signal) {
  case SIGSEGV: return "SIGSEGV";
  case SIGBUS: return "SIGBUS";
  case SIGILL: return "SIGILL";
  case SIGFPE: return "SIGFPE";
  default: return "SIGABRT";
  }
}

/// In a signal handler: nothing here may allocate or lock. The signal's own action follows when it returns.
extern "C" void reportCrash(int signal) {
  say("stadion: crashed with ");
  say(nameOf(signal));
  say(", which is a fault of the program; it was at\n");
  void* frames[kFrames];
  backtrace_symbols_fd(frames, backtrace(frames, kFrames), STDERR_FILENO);
  raise(signal);
}

}  // namespace

void reportCrashes() {
  void* first[1];
  backtrace(first, 1);  // loads what it needs, which the handler could not
  for (const int signal : kSignals) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) continue;
    struct sigaction report {};
    report.sa_handler = reportCrash;
    report.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(signal, &report, nullptr);
  }
}

}  // namespace stadion
