#pragma once
/// Another program, run with its streams connected to ours.
///
/// Ownership  owns the child: a destructor that finds it running kills it and waits for it.
/// Threads    one thread at a time.
/// Errors     start() says why there is no child; no signal and no exception.

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace stadion {

/// A file descriptor that is closed with its owner, and never inherited by accident.
class Descriptor {
public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& o) noexcept : fd_(o.fd_) { o.fd_ = -1; }
  Descriptor& operator=(Descriptor&& o) noexcept;
  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  void close();

private:
  int fd_;
};

class ChildProcess {
public:
  /// What the child sees as its standard streams; -1 = /dev/null.
  struct Streams {
    int in = -1, out = -1, err = -1;
  };

  ChildProcess() = default;
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Own: Ctrl-C reaches us alone, and we can let it finish what it is at. Ours: keys of the terminal, Ctrl-C
  /// and Ctrl-Z among them, reach it as they reach us.
  enum class Group { Own, Ours };

  /// Finds argv[0] along PATH and runs it with default signal handling, in that process group, with our
  /// environment where `environment`, words like "NAME=value", says nothing else. Nothing if it runs, else an
  /// errno.
  std::optional<int> start(const std::vector<std::string>& argv, const Streams& streams,
                           const std::vector<std::string>& environment = {}, Group group = Group::Own);
  bool running() const { return pid_ > 0; }
  pid_t pid() const { return pid_; }  ///< -1 if there is none

  /// The exit status (128 + signal if it was killed) once it has ended; nothing if it still runs after the
  /// wait.
  std::optional<int> wait(std::chrono::milliseconds limit);
  /// It and, if that is its own, all of its process group: the programs that it has started, too.
  void kill();

private:
  pid_t pid_ = -1;
  Group group_ = Group::Own;
};

/// A pipe: what is written to `write` comes out of `read`. Both invalid if the system has none to give.
struct Pipe {
  Descriptor read, write;
};
Pipe makePipe();

/// A nameless file in memory, to collect what a child says. Invalid if there is none to be had.
Descriptor makeMemoryFile();
/// The first `limit` bytes of it.
std::string contentOf(const Descriptor& file, std::size_t limit = 4096);

}  // namespace stadion
