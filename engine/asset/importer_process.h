#pragma once
/// One running importer program, and the exchange with it.
///
/// Errors   If the program crashes, hangs or sends nonsense, ask() returns and says so; the next ask() starts
///          a new one. No signal reaches the show.
/// Threads  one caller at a time.

#include "engine/asset/importer_protocol.h"
#include "engine/base/file_descriptor.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace stadion {

class ImporterProcess {
public:
  explicit ImporterProcess(std::filesystem::path program) : program_(std::move(program)) {}
  ~ImporterProcess() { stop(); }
  ImporterProcess(const ImporterProcess&) = delete;
  ImporterProcess& operator=(const ImporterProcess&) = delete;

  enum class End { Loaded, Failed, OutOfMemory, OutOfTime, Crashed, Nonsense, NotStarted };

  struct Answer {
    End end = End::Failed;
    std::string text;                ///< the inventory, or the reason
    std::vector<std::uint8_t> mesh;  ///< when Loaded; not checked yet
  };

  /// Has the file `path` below the open folder `root` imported, and waits at most `timeout`, or until
  /// `giveUp` (if it is given) becomes true; both end as OutOfTime.
  Answer ask(RequestHead head, int root, const std::string& path, const NodeSelection& nodes,
             std::chrono::milliseconds timeout, const std::atomic<bool>* giveUp = nullptr);

  const std::filesystem::path& program() const { return program_; }
  /// Process id of the running program, 0 if none runs (for tests that kill it).
  int pid() const { return pid_; }
  /// How many programs have been started so far.
  int started() const { return started_; }

private:
  std::string start();
  void stop();
  Answer fault(End end);

  std::filesystem::path program_;
  FileDescriptor socket_;
  int pid_ = 0;
  int started_ = 0;
};

}  // namespace stadion
