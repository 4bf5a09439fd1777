#include "bench/comparison/program_output.h"

#include "engine/base/file_descriptor.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>

namespace stadion::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Reads until the other end is closed. Returns false if that took too long.
bool readAll(int fd, std::chrono::seconds limit, std::string& text) {
  const Clock::time_point end = Clock::now() + limit;
  char part[4096];
  for (;;) {
    if (limit.count() > 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
      pollfd wait{fd, POLLIN, 0};
      const int ready = left > 0 ? poll(&wait, 1, static_cast<int>(left)) : 0;
      if (ready == 0) return false;
      if (ready < 0 && errno == EINTR) continue;
    }
    const ssize_t n = read(fd, part, sizeof part);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    text.append(part, static_cast<std::size_t>(n));
  }
}

std::vector<std::string> environmentFor(const ProgramCall& call) {
  std::vector<std::string> settings{"LD_BIND_NOW=1"};
  const auto nameOf = [](const std::string& setting) { return setting.substr(0, setting.find('=')); };
  for (char** entry = environ; *entry; ++entry)
    if (std::ranges::none_of(call.environment,
                             [&](const std::string& own) { return nameOf(own) == nameOf(*entry); }))
      settings.emplace_back(*entry);
  for (const std::string& own : call.environment)
    if (own.find('=') != std::string::npos) settings.push_back(own);
  return settings;
}

std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

std::string outputOf(const ProgramCall& call) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {};
  const FileDescriptor from(ends[0]);
  FileDescriptor to(ends[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to.get(), STDOUT_FILENO);
  std::vector<std::string> words = call.words, settings = environmentFor(call);
  const std::vector<char*> arguments = pointersTo(words), environment = pointersTo(settings);
  pid_t child = 0;
  const int wrong =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  to.close();
  if (wrong) return {};
  std::string text;
  if (!readAll(from.get(), call.limit, text)) {
    kill(child, SIGKILL);
    text.clear();
  }
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return text;
}

}  // namespace stadion::bench
