#include "cli/program.h"

#include "cli/exit_code.h"
#include "cli/options/command_reference.h"
#include "cli/options/retired_spellings.h"
#include "engine/plain_text/suggestion.h"
#include "pipeline/sound/sound_libraries.h"
#include "pipeline/target/rasteriser_settings.h"
#include "show/base/version.h"
#include "show/recording/crash_report.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <new>
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

int runCommand(int argc, char** argv, const AddCommands& addCommands,
               std::optional<unsigned> rasteriserThreads) {
  CLI::App app("Stadion plays immersive shows written in the EVS world description language on stereo walls.",
               "stadion");
  app.footer("Exit codes: 0 ok, 1 a check or comparison failed, 2 bad usage or bad input, 3 internal fault,\n"
             "4 in a cluster: the leader has other files, 130 or 143 stopped by SIGINT or SIGTERM.\n"
             "Start with:  ./stadion run scripts/kick.evs --out pictures");
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
  if (const auto retired = retiredSpellingIn(words))
    return std::fprintf(stderr, "stadion: %s\n", retired->c_str()), kBadInput;
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
    return kBadInput;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kOk : kBadInput;
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
    const int code = runCommand(argc, argv, addCommands, rasteriserThreads);
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    std::fprintf(stderr, "stadion: the standard output cannot be written: %s\n", std::strerror(errno));
    return code == kOk ? kBadInput : code;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "stadion: out of memory\n");
    return kInternalFault;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "stadion: internal fault: %s\n", e.what());
    return kInternalFault;
  }
}

}  // namespace stadion
