#include "cli/program.h"

#include "cli/exit_code.h"
#include "cli/json_errors.h"
#include "cli/options/command_reference.h"
#include "cli/options/option_table.h"
#include "cli/options/retired_spellings.h"
#include "engine/plain_text/suggestion.h"
#include "pipeline/sound/sound_libraries.h"
#include "pipeline/target/rasteriser_settings.h"
#include "show/base/version.h"
#include "show/recording/crash_report.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <new>
#include <poll.h>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace stadion {
namespace {

/// If the program was started with a standard stream closed, the next file that it opens would take its
/// place, and messages would be written into that file. The streams are opened the wrong way round, so that
/// their use is still an error.
void occupyStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int refuse(const std::string& error) {
  std::fprintf(stderr, "stadion: %s\n", error.c_str());
  return kBadInput;
}

/// Whether standard output is a pipe that no process reads any more.
bool readerIsGone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

/// Returns the exit status of a command that ended with `code`, when all its output has been written or is
/// lost.
int finishOutput(int code) {
  const bool lostBefore = std::ferror(stdout) != 0;
  if (std::fflush(stdout) == 0 && !lostBefore) return code;
  const int why = errno;
  if (readerIsGone()) return code == kOk ? kReaderGone : code;  // `| head` has seen enough: no fault
  std::fprintf(stderr, "stadion: the standard output cannot be written%s\n",
               lostBefore ? "" : (std::string(": ") + std::strerror(why)).c_str());
  return code == kOk ? kBadInput : code;
}

/// Returns the exit status of a command line that names no command to run: wrong, or with --help.
int exitOfParser(const CLI::App& app, const CLI::Error& why) {
  std::ostringstream out, err;
  const bool isWrong = app.exit(why, out, err) != 0;
  std::fputs(out.str().c_str(), stdout);
  std::fputs(err.str().c_str(), stderr);
  return isWrong ? kBadInput : kOk;
}

int runCommand(int argc, char** argv, const AddCommands& addCommands,
               std::optional<unsigned> rasteriserThreads) {
  CLI::App app("Stadion plays immersive shows written in the EVS world description language on stereo walls.",
               "stadion");
  app.footer(std::string("Exit codes: ") + kExitStatusText +
             "\nStart with:  ./stadion run scripts/kick.evs --out pictures");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("stadion ") + kVersion);
  int code = kOk;
  addCommands(app, code, rasteriserThreads);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  try {
    if (const auto answer = referenceAnswer(app, words)) {
      std::fputs(answer->c_str(), stdout);
      return kOk;
    }
  } catch (const std::runtime_error& e) {
    return refuse(e.what());
  }
  if (const auto retired = retiredSpellingIn(words)) return refuse(*retired);
  if (const auto wrong = flagWithValueIn(words)) return refuse(*wrong);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& e) {
    if (argc > 1 && app.get_subcommands().empty()) {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      std::fprintf(stderr, "stadion: there is no subcommand \"%s\"%s\n", argv[1],
                   didYouMean(argv[1], known).c_str());
    }
    return exitOfParser(app, e);
  } catch (const CLI::ParseError& e) {
    return exitOfParser(app, e);
  }
  return code;
}

/// As runCommand(), and an exception that escapes becomes an exit status.
int runGuarded(int argc, char** argv, const AddCommands& addCommands) {
  try {
    const auto rasteriserThreads = rasteriserThreadsGiven();
    if (const auto wrong = pinRasteriser()) return refuse(wrong->message);
    quietOpenAl();
    return runCommand(argc, argv, addCommands, rasteriserThreads);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "stadion: out of memory\n");
  } catch (const std::exception& e) {
    std::fprintf(stderr, "stadion: internal fault: %s\n", e.what());
  }
  return kInternalFault;
}

}  // namespace

int runProgram(int argc, char** argv, const AddCommands& addCommands) {
  occupyStandardStreams();
  reportCrashes();
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file that may not grow is a full disk: an error with a name, not the end
  const auto given = [&](const char* option) {
    return std::any_of(argv, argv + argc, [&](const char* word) { return !std::strcmp(word, option); });
  };
  // A supervised player has the options of its supervisor, writes to the same output, and says why it failed.
  JsonErrors errors(given("--json") && !given("--supervise"));
  const int code = runGuarded(argc, argv, addCommands);
  errors.finish(code);
  return finishOutput(code);
}

}  // namespace stadion
