#include "pipeline/platform/child_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

/// posix_spawn's two lists of instructions, freed with their owner.
class SpawnOrders {
public:
  SpawnOrders() {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
  }
  ~SpawnOrders() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnOrders(const SpawnOrders&) = delete;
  SpawnOrders& operator=(const SpawnOrders&) = delete;

  void connect(int from, int to) {
    if (from < 0)
      posix_spawn_file_actions_addopen(&actions_, to, "/dev/null", to == 0 ? O_RDONLY : O_WRONLY, 0);
    else
      posix_spawn_file_actions_adddup2(&actions_, from, to);
  }

  /// We block and ignore some signals; the child starts without these settings.
  void resetSignals(ChildProcess::Group group) {
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    const int own = group == ChildProcess::Group::Own ? POSIX_SPAWN_SETPGROUP : 0;
    posix_spawnattr_setflags(&attributes_,
                             static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | own));
  }

  posix_spawn_file_actions_t* actions() { return &actions_; }
  posix_spawnattr_t* attributes() { return &attributes_; }

private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// Returns a copy of `fd` that connecting the standard streams does not overwrite; none if `fd` is safe
/// already.
FileDescriptor aboveStandard(int& fd) {
  FileDescriptor copy(fd >= 0 && fd <= 2 ? fcntl(fd, F_DUPFD_CLOEXEC, 3) : -1);
  if (copy) fd = copy.get();
  return copy;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Returns our environment, in which these words replace those with the same names.
std::vector<std::string> environmentWith(const std::vector<std::string>& words) {
  std::vector<std::string> all = words;
  for (char** at = environ; *at; ++at) {
    const std::string_view ours(*at);
    const auto sameName = [&](const std::string& word) {
      return ours.starts_with(std::string_view(word).substr(0, word.find('=') + 1));
    };
    if (std::ranges::none_of(words, sameName)) all.emplace_back(ours);
  }
  return all;
}

}  // namespace

ChildProcess::~ChildProcess() {
  if (!running()) return;
  kill();
  wait(std::chrono::milliseconds(5000));
}

std::optional<int> ChildProcess::start(const std::vector<std::string>& argv, const Streams& streams,
                                       const std::vector<std::string>& environment, Group group) {
  Streams from = streams;
  const FileDescriptor in = aboveStandard(from.in), out = aboveStandard(from.out),
                       err = aboveStandard(from.err);
  SpawnOrders orders;
  orders.connect(from.in, 0);
  orders.connect(from.out, 1);
  orders.connect(from.err, 2);
  orders.resetSignals(group);
  group_ = group;
  std::vector<std::string> words = argv, around = environmentWith(environment);
  const std::vector<char*> arguments = pointersTo(words), variables = pointersTo(around);
  const int problem = posix_spawnp(&pid_, arguments[0], orders.actions(), orders.attributes(),
                                   arguments.data(), variables.data());
  if (problem == 0) return std::nullopt;
  pid_ = -1;
  return problem;
}

std::optional<int> ChildProcess::wait(std::chrono::milliseconds limit) {
  const auto deadline = Clock::now() + limit;
  while (running()) {
    int status = 0;
    const pid_t ended = waitpid(pid_, &status, WNOHANG);
    if (ended == pid_) {
      pid_ = -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    if (ended < 0 && errno != EINTR) {
      pid_ = -1;
      return 127;
    }
    if (Clock::now() >= deadline) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return 127;
}

void ChildProcess::kill() {
  if (running()) ::kill(group_ == Group::Own ? -pid_ : pid_, SIGKILL);
}

Pipe makePipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return Pipe{FileDescriptor(), FileDescriptor()};
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

FileDescriptor makeMemoryFile() {
  return FileDescriptor(memfd_create("stadion-child", MFD_CLOEXEC));
}

std::string contentOf(const FileDescriptor& file, std::size_t limit) {
  std::string text(limit, '\0');
  const ssize_t got = file ? pread(file.get(), text.data(), text.size(), 0) : 0;
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return text;
}

}  // namespace stadion
