#pragma once
/// Another program, run with its streams connected to ours.
///
/// Ownership  owns the child: a destructor that finds it running kills it and waits for it.
/// Threads    one thread at a time.
/// Errors     start() says why there is no child; no signal and no exception.

#include "engine/base/file_descriptor.h"

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace stadion {

class ChildProcess {
public:
  /// The child's standard streams; -1 = /dev/null.
  struct Streams {
    int in = -1, out = -1, err = -1;
  };

  ChildProcess() = default;
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Own: Ctrl-C reaches us alone, so we can let the child finish its work. Ours: keys of the terminal, such
  /// as Ctrl-C and Ctrl-Z, reach the child as they reach us.
  enum class Group { Own, Ours };

  /// Finds argv[0] along PATH and runs it with default signal handling, in that process group. It gets our
  /// environment, in which the words of `environment`, such as "NAME=value", take precedence. Returns nothing
  /// if it runs, else an errno.
  std::optional<int> start(const std::vector<std::string>& argv, const Streams& streams,
                           const std::vector<std::string>& environment = {}, Group group = Group::Own);
  bool running() const { return pid_ > 0; }
  pid_t pid() const { return pid_; }  ///< -1 if there is none

  /// Returns the exit status (128 + signal if it was killed) once the child has ended. Returns nothing if it
  /// still runs after the wait.
  std::optional<int> wait(std::chrono::milliseconds limit);
  /// Kills the child. If it has its own process group, kills the whole group: also the programs that it has
  /// started.
  void kill();

private:
  pid_t pid_ = -1;
  Group group_ = Group::Own;
};

/// A pipe: `read` returns the data written to `write`. Both are invalid if the system has none left.
struct Pipe {
  FileDescriptor read, write;
};
Pipe makePipe();

/// Returns a nameless file in memory, which collects a child's output. Invalid if the system has none left.
FileDescriptor makeMemoryFile();
/// Returns its first `limit` bytes.
std::string contentOf(const FileDescriptor& file, std::size_t limit = 4096);

}  // namespace stadion
