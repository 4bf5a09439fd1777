#include "profiling/record/processor_time.h"

#include <cctype>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace stadion {
namespace {

double seconds(const timespec& t) {
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

/// The content of /proc/PID/stat.
struct Process {
  pid_t number = 0, parent = 0;
  double ended = 0;  ///< of its children that have ended [s]
};

/// number 0: the process has ended.
Process processAt(const std::filesystem::path& folder) {
  std::ifstream in(folder / "stat");
  std::string text;
  std::getline(in, text);
  const std::size_t name = text.rfind(')');  // the name before it may contain any characters
  if (name == std::string::npos) return {};
  char state = 0;
  int parent = 0;
  long childrenUser = 0, childrenSystem = 0;
  if (std::sscanf(text.c_str() + name + 1, " %c %d %*d %*d %*d %*d %*u %*u %*u %*u %*u %*u %*u %ld %ld",
                  &state, &parent, &childrenUser, &childrenSystem) != 4)
    return {};
  const auto ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
  return {std::stoi(folder.filename()), parent, static_cast<double>(childrenUser + childrenSystem) / ticks};
}

std::multimap<pid_t, Process> processesByParent() {
  std::multimap<pid_t, Process> all;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", none)) {
    const std::string name = entry.path().filename();
    if (!std::isdigit(static_cast<unsigned char>(name.front()))) continue;
    const Process p = processAt(entry.path());
    if (p.number) all.insert({p.parent, p});
  }
  return all;
}

/// Returns the time of all its threads, including those that have ended; 0 if the process has ended.
double ownSeconds(pid_t process) {
  clockid_t clock{};
  timespec t{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &t) != 0) return 0;
  return seconds(t);
}

}  // namespace

double processorSeconds() {
  timespec self{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &self);
  rusage ended{};
  getrusage(RUSAGE_CHILDREN, &ended);
  double sum = seconds(self) + seconds(ended.ru_utime) + seconds(ended.ru_stime);
  const std::multimap<pid_t, Process> processes = processesByParent();
  std::vector<pid_t> parents{getpid()};
  while (!parents.empty()) {
    const auto [first, last] = processes.equal_range(parents.back());
    parents.pop_back();
    for (auto child = first; child != last; ++child) {
      sum += ownSeconds(child->second.number) + child->second.ended;
      parents.push_back(child->second.number);
    }
  }
  return sum;
}

}  // namespace stadion
