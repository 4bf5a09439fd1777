#include "show/regress/regress_child.h"

#include "engine/base/plain_file.h"
#include "pipeline/platform/child_process.h"
#include "show/base/error_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/socket.h>
#include <sys/stat.h>

namespace stadion {
namespace {

std::string everythingIn(const FileDescriptor& file) {
  struct stat info {};
  return fstat(file.get(), &info) == 0 ? contentOf(file, static_cast<std::size_t>(info.st_size)) : "";
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

/// The log that plays beside a show when nothing else is asked for.
std::string logBeside(const std::string& show) {
  return std::filesystem::path(show).replace_extension(".input").string();
}

using Clock = std::chrono::steady_clock;

/// A child and what it says.
struct RunningChild {
  FileDescriptor out = makeMemoryFile(), err = makeMemoryFile();
  ChildProcess child;
  ChildResult result;

  void start(const std::vector<std::string>& words, int in, const std::vector<std::string>& environment) {
    const auto problem = child.start(words, {in, out.get(), err.get()}, environment);
    if (!problem) return;
    result.fault = fmt::format("{} cannot be started: {}", words.front(), std::strerror(*problem));
    result.missing = *problem == ENOENT;
  }

  /// Waits a little. Once it has ended, or was given up, the result is complete.
  bool ended(std::chrono::milliseconds wait) {
    if (result.status >= 0 || !result.fault.empty()) return true;
    const auto status = child.wait(wait);
    if (!status) return false;
    result.status = *status;
    result.out = everythingIn(out);
    result.err = everythingIn(err);
    if (*status == 0) return true;
    const std::string said = reasonIn(result.err);
    result.fault = *status > 128
                       ? fmt::format("signal {} ended it{}{}", *status - 128, said.empty() ? "" : ": ", said)
                       : fmt::format("exit status {}: {}", *status, said);
    return true;
  }

  void giveUpIf(bool stop, Clock::time_point deadline, std::chrono::seconds limit) {
    if (result.status >= 0 || !result.fault.empty()) return;
    if (stop)
      result.fault = "stopped";
    else if (Clock::now() > deadline)
      result.fault = fmt::format("it did not end within {} s (--limit)", limit.count());
    if (!result.fault.empty()) child.kill();
  }
};

}  // namespace

ChildResult runChild(const std::vector<std::string>& words, std::chrono::seconds limit,
                     const std::atomic<bool>& stop, const std::vector<std::string>& environment) {
  RunningChild child;
  child.start(words, -1, environment);
  const auto deadline = Clock::now() + limit;
  while (!child.ended(std::chrono::milliseconds(200))) child.giveUpIf(stop, deadline, limit);
  return std::move(child.result);
}

std::pair<ChildResult, ChildResult> runInTurns(const std::vector<std::string>& first,
                                               const std::vector<std::string>& second,
                                               std::chrono::seconds limit, const std::atomic<bool>& stop,
                                               const std::vector<std::string>& environment) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    ChildResult none;
    none.fault = "there is no socket to be had";
    return {none, none};
  }
  FileDescriptor ofFirst(ends[0]), ofSecond(ends[1]);
  const char turn = 't';
  (void)!send(ofSecond.get(), &turn, 1, MSG_NOSIGNAL);  // what one end sends the other one reads
  RunningChild a, b;
  a.start(first, ofFirst.get(), environment);
  b.start(second, ofSecond.get(), environment);
  ofFirst.close();
  ofSecond.close();  // so that each child learns when the other one has ended
  const auto deadline = Clock::now() + limit;
  for (;;) {
    const bool aEnded = a.ended(std::chrono::milliseconds(10)),
               bEnded = b.ended(std::chrono::milliseconds(10));
    if (aEnded && bEnded) break;
    a.giveUpIf(stop, deadline, limit);
    b.giveUpIf(stop, deadline, limit);
  }
  return {std::move(a.result), std::move(b.result)};
}

std::string textOf(const std::string& file) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 30;
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  return text ? text.value() : std::string();
}

std::vector<std::string> warningsIn(const std::string& said) {
  std::vector<std::string> warnings;
  for (const std::string& line : linesOf(said))
    if ((isFinding(line, "warning") || isFinding(line, "error")) &&
        std::ranges::find(warnings, line) == warnings.end())
      warnings.push_back(line);
  return warnings;
}

std::vector<std::string> playWords(const std::string& program, const regression::SuiteCase& c,
                                   const std::string& mode) {
  std::vector<std::string> words{program, "run",      c.show,   "--walls", c.walls, "--mode",
                                 mode,    "--stereo", c.stereo, "--pace",  "free",  "--json"};
  const auto add = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  if (c.look != "full") add("--look", c.look);  // unasked it is full, also of builds that know no other
  if (!c.size.empty()) add("--size", c.size);
  if (c.rate > 0) add("--rate", fmt::format("{}", c.rate));
  if (c.frames > 0) add("--frames", std::to_string(c.frames));
  // To the end of a log, without a clock that decides: the log must be named.
  if (!c.input.empty())
    add("--input", c.input);
  else if (c.frames == 0)
    add("--input", logBeside(c.show));
  for (const std::string& root : c.assetRoots) add("--asset-root", root);
  words.insert(words.end(), c.renderer.begin(), c.renderer.end());
  return words;
}

}  // namespace stadion
