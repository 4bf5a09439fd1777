/// `stadion run SHOW`: plays a show.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/run_options.h"
#include "cli/terminal.h"
#include "engine/base/file_descriptor.h"
#include "engine/base/run_stopped.h"
#include "pipeline/record/journal.h"
#include "show/base/stop_signal.h"
#include "show/session/show_session.h"
#include "show/supervision/supervisor.h"
#include "show/web/web_address.h"
#include "show/web/web_token.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

/// How long a show lasts that is not seen, or how it ends.
void tellLength(const RunOptions& o, const Player& player) {
  if (player.frames() == 0 && player.end() == 0) {
    std::fprintf(stderr, "no input log beside the show and no --frames: playing until Ctrl-C\n");
  } else if (o.settings.record.out.empty() && !o.settings.play.display) {
    const double seconds =
        player.end() > 0 ? toSeconds(player.end()) : static_cast<double>(player.frames() - 1) / player.rate();
    std::fprintf(
        stderr,
        "playing %.1f s of %s unseen; --display and stadion view show it, --out DIR writes pictures\n",
        seconds, o.settings.show.script.c_str());
  }
}

/// Lines are the output of a run that tells hashes; with --json that is the summary.
std::FILE* hashFile(const RunOptions& o) {
  return o.json ? stderr : stdout;
}

std::FILE* summaryFile(const RunOptions& o) {
  const RecordSettings& r = o.settings.record;
  return r.hashes && r.out.empty() && !o.json ? stderr : stdout;
}

void print(const RunOptions& o, const SessionReport& report) {
  constexpr std::size_t kNodes = 10;
  RunSummary summary = report.summary;
  summary.stereo = o.stereo;
  const std::string& script = o.settings.show.script;
  if (o.json) {
    std::printf("%s\n", toJson(summary).c_str());
  } else {
    std::fprintf(summaryFile(o), "%s%s", toText(summary).c_str(), eventsText(summary).c_str());
    if (o.settings.record.out.empty() && !o.settings.play.display)
      std::fprintf(summaryFile(o), "\nTo see it:  ./stadion view %s, or ./stadion run %s --out pictures\n",
                   script.c_str(), script.c_str());
  }
  if (report.figures) std::fprintf(stderr, "\n%s", toText(*report.figures, kNodes).c_str());
  std::fputs(report.lateFrames.c_str(), stderr);
}

/// This command line, for a player that ends with this process.
std::vector<std::string> playerWords(int descriptor) {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  std::erase(words, "--supervise");
  words.front() = std::filesystem::canonical("/proc/self/exe").string();
  const auto run = std::ranges::find(words, "run");
  const std::vector<std::string> own{"--supervised", std::to_string(descriptor), "--ends-with",
                                     std::to_string(getpid())};
  words.insert(run == words.end() ? run : std::next(run), own.begin(), own.end());
  return words;
}

/// The token of the operator's page, which all players of a supervised show share: a nameless file in memory, which
/// they inherit. Invalid if the page is not asked for, or has a token file.
FileDescriptor sharedWebToken(const WebSettings& web, Reporter& terminal) {
  if (web.address.empty() || !web.tokenFile.empty()) return {};
  const auto token = WebToken::make();
  FileDescriptor file(token ? memfd_create("stadion-token", 0) : -1);
  if (!file || fchmod(file.get(), S_IRUSR) != 0) return {};
  const std::string& text = token.value().text();
  if (write(file.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) return {};
  const auto address = WebAddress::parse(web.address);
  if (address) terminal.hint("web: open http://" + address.value().authority() + "/#" + text);
  return file;
}

int superviseShow(const RunOptions& o, Reporter& terminal) {
  const FileDescriptor token = sharedWebToken(o.settings.web, terminal);
  const auto words = [&](int descriptor) {
    std::vector<std::string> player = playerWords(descriptor);
    if (token) player.insert(player.end(), {"--web-token", "/proc/self/fd/" + std::to_string(token.get())});
    return player;
  };
  const auto supervisor = Supervisor::create(o.settings.supervision, words, terminal);
  if (!supervisor) return kBadInput;
  outliveReaders();
  return supervisor->play(catchStopSignals());
}

int playShow(const RunOptions& o, Reporter& terminal, Diagnostics findings) {
  const std::atomic<bool>& stop = catchStopSignals();
  outliveReaders();
  if (o.endsWith > 0) stopWithParent(o.endsWith);
  SessionSettings settings = o.settings;
  settings.record.hashLines = [file = hashFile(o)](const std::string& lines) {
    std::fputs(lines.c_str(), file);
    std::fflush(file);
  };
  ShowSession session(std::move(settings), terminal, stop);
  if (session.open(std::move(findings))) {
    if (!session.follows()) tellLength(o, session.player());  // only the leader knows how long the show is
    session.play();
    if (const SessionReport* report = session.report()) print(o, *report);
  }
  return statusOf(session.end());
}

int runShow(RunOptions o) try {
  Diagnostics findings;
  if (!o.complete(findings)) return exitWith(findings, kBadInput);
  o.settings.supervision.service = ServiceAddress::ofEnvironment();
  TerminalReporter terminal;
  if (o.supervise) {
    printFindings(findings);
    return superviseShow(o, terminal);
  }
  return playShow(o, terminal, std::move(findings));
} catch (const RunStopped&) {
  std::fprintf(stderr, "stadion: stopped by %s before the show was loaded\n", stopSignalName());
  return kStopped + stopSignal();
}

}  // namespace

void addRunCommand(CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads) {
  auto o = std::make_shared<RunOptions>();
  o->settings.draw.rasteriserThreads = rasteriserThreads;
  CLI::App* command = app.add_subcommand("run", "Play a show: simulate, cull and draw it on all walls");
  addRunOptions(*command, *o);
  command->callback([o, &code] { code = runShow(*o); });
}

}  // namespace stadion
