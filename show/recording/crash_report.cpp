#include "show/recording/crash_report.h"

#include <atomic>
#include <csignal>
#include <execinfo.h>
#include <iterator>
#include <string_view>
#include <unistd.h>

namespace stadion {
namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
constexpr int kFrames = 64;

/// A signal handler can reach nothing but what has a fixed place.
struct ToldFile {
  enum State : int { Free, Filling, Told };
  std::atomic<int> state = Free;
  char name[1024] = {};
};
ToldFile toldFiles[4];

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
  for (const ToldFile& file : toldFiles) {
    if (file.state != ToldFile::Told) continue;
    say("stadion: what the last frames were spent on: stadion profile --black-box ");
    say(file.name);
    say("\n");
  }
  raise(signal);
}

}  // namespace

CrashFileRegistration::CrashFileRegistration(const std::string& file) {
  if (file.size() >= sizeof ToldFile::name) return;
  for (int i = 0; i < static_cast<int>(std::size(toldFiles)); ++i) {
    int free = ToldFile::Free;
    if (!toldFiles[i].state.compare_exchange_strong(free, ToldFile::Filling)) continue;
    toldFiles[i].name[file.copy(toldFiles[i].name, file.size())] = 0;
    toldFiles[i].state = ToldFile::Told;
    place_ = i;
    return;
  }
}

CrashFileRegistration::~CrashFileRegistration() {
  if (place_ >= 0) toldFiles[place_].state = ToldFile::Free;
}

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
