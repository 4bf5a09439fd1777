#pragma once
/// Runs a program as a user would: words in, exit status and texts out.

#include "cli/terminal.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace stadion {

struct ProgramResult {
  int status = -1;  ///< exit status; 128 + signal if it was killed
  std::string out, err;
  double seconds = 0;
};

struct ProgramRun {
  std::vector<std::string> words;          ///< the program first, found along PATH
  std::vector<std::string> environment{};  ///< "NAME=value", over the caller's own
  std::string folder{};                    ///< where to start it; empty = here
  /// A signal to its whole process group, as a terminal would send it; 0 = none.
  int signal = 0;
  std::chrono::milliseconds signalAfter{500};
  std::chrono::seconds limit{600};  ///< killed past it: no measure of speed, a machine may be busy
  /// The signal waits until this is true of what it has written so far, and then for `signalAfter`. Without
  /// it, a busy machine may send the signal before the program has begun.
  std::function<bool(const std::string& out, const std::string& err)> signalWhen{};
};

/// A live run without an input log plays.
inline bool playsLive(const std::string&, const std::string& err) {
  return err.find("playing until Ctrl-C") != std::string::npos;
}

ProgramResult runProgram(const ProgramRun& run);
/// Starts it and returns its number, which is that of its process group too; its texts go to these files.
pid_t startProgram(const ProgramRun& run, const std::string& out, const std::string& err);

/// The built `stadion` with these arguments.
ProgramResult stadionProgram(std::vector<std::string> arguments);
std::string stadionPath();

/// A file of tests/corpus/shows.
std::string testShow(const std::string& name);
/// The folder of the show's own models, for `--asset-root`.
std::string assetFolder();

/// A folder that goes when the test does.
class TestFolder {
public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file in it and returns its path.
  std::string write(const std::string& name, const std::string& content) const;

private:
  std::filesystem::path path_;
};

std::string fileContent(const std::filesystem::path& file);
/// Whether the long acceptance runs were asked for (`stadion test --full`).
bool fullRuns();

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace stadion
