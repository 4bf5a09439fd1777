#include "cli/program.h"

#include "cli/exit_code.h"
#include "cli/findings_json.h"
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
#include <stdexcept>
#include <unistd.h>

namespace stadion {
namespace {

/// If the program was started with a standard stream closed, the next file that it opens would take its place,
/// and messages would be written into that file. The streams are opened the wrong way round, so that their use
/// is still an error.
void occupyStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// With --json, standard output is an object also if the command line is wrong.
void printErrorAsJson(const std::string& error, const std::vector<std::string>& words) {
  if (std::ranges::find(words, "--json") == words.end()) return;
  printJson({{"error", error}});
}

int refuse(const std::string& error, const std::vector<std::string>& words) {
  std::fprintf(stderr, "stadion: %s\n", error.c_str());
  printErrorAsJson(error, words);
  return kBadInput;
}

/// Whether standard output is a pipe that no process reads any more.
bool readerIsGone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

/// Returns the exit status of a command that ended with `code`, when all its output has been written or is lost.
int finishOutput(int code) {
  const bool lostBefore = std::ferror(stdout) != 0;
  if (std::fflush(stdout) == 0 && !lostBefore) return code;
  const int why = errno;
  if (readerIsGone()) return code == kOk ? kReaderGone : code;  // `| head` has seen enough: no fault
  std::fprintf(stderr, "stadion: the standard output cannot be written%s\n",
               lostBefore ? "" : (std::string(": ") + std::strerror(why)).c_str());
  return code == kOk ? kBadInput : code;
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
    std::fprintf(stderr, "stadion: %s\n", e.what());
    return kBadInput;
  }
  if (const auto retired = retiredSpellingIn(words)) return refuse(*retired, words);
  if (const auto wrong = flagWithValueIn(words)) return refuse(*wrong, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& e) {
    if (argc > 1 && app.get_subcommands().empty()) {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      std::fprintf(stderr, "stadion: there is no subcommand \"%s\"%s\n", argv[1],
                   didYouMean(argv[1], known).c_str());
    }
    app.exit(e);
    printErrorAsJson(e.what(), words);
    return kBadInput;
  } catch (const CLI::ParseError& e) {
    if (app.exit(e) == 0) return kOk;
    printErrorAsJson(e.what(), words);
    return kBadInput;
  }
  return code;
}

}  // namespace

int runProgram(int argc, char** argv, const AddCommands& addCommands) {
  occupyStandardStreams();
  reportCrashes();
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file that may not grow is a full disk: an error with a name, not the end
  try {
    const auto rasteriserThreads = rasteriserThreadsGiven();
    if (const auto wrong = pinRasteriser()) {
      std::fprintf(stderr, "stadion: %s\n", wrong->message.c_str());
      return kBadInput;
    }
    quietOpenAl();
    return finishOutput(runCommand(argc, argv, addCommands, rasteriserThreads));
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "stadion: out of memory\n");
    return kInternalFault;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "stadion: internal fault: %s\n", e.what());
    return kInternalFault;
  }
}

}  // namespace stadion
