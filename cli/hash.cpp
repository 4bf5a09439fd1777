/// `stadion hash SHOW`: the state hash of every frame, nothing drawn.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "cli/options/command_options.h"
#include "cli/options/show_options.h"
#include "cli/terminal.h"
#include "show/player/output_conflicts.h"
#include "show/player/player.h"
#include "show/recording/state_file.h"

#include <CLI/CLI.hpp>
#include <cinttypes>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

struct HashOptions {
  ShowOptions show;
  std::string saveState, compareState;
  bool json = false;
};

void printHash(std::uint64_t frame, std::uint64_t hash, bool json) {
  std::printf(json ? "{\"frame\":%" PRIu64 ",\"hash\":\"%016" PRIx64 "\"}\n" : "%" PRIu64 " %016" PRIx64 "\n",
              frame, hash);
}

/// Of the last frame, as the options ask. `other`: the state to compare with.
int keepState(Scene& scene, const HashOptions& o, const std::optional<StateFile>& other) {
  Diagnostics findings;
  if (!o.saveState.empty())
    if (const auto wrong = saveState(scene, o.saveState)) findings.add(*wrong);
  printFindings(findings);
  if (findings.hasErrors()) return kBadInput;
  const auto difference = other ? other->differenceFrom(scene) : std::nullopt;
  if (!difference) return kOk;
  if (o.json)
    printJson({{"difference",
                {{"where", difference->where},
                 {"here", difference->here},
                 {"there", difference->there},
                 {"file", o.compareState}}}});
  else
    std::printf("difference: %s is %s here and %s in %s\n", difference->where.c_str(),
                difference->here.c_str(), difference->there.c_str(), o.compareState.c_str());
  return kCheckFailed;
}

/// Nothing if none was asked for, or with the findings.
std::optional<StateFile> stateToCompare(const HashOptions& o, Diagnostics& findings) {
  if (o.compareState.empty()) return {};
  auto read = StateFile::read(o.compareState);
  if (read) return std::move(read.value());
  findings.add(read.error());
  return {};
}

int hashShow(const HashOptions& o) {
  ShowOptions options = o.show;
  options.isDrawn = false;
  Diagnostics findings;
  const std::vector<NamedFile> files{{"--save-state", o.saveState},
                                     {"--compare-state", o.compareState, false}};
  refuseOverwriting({&options, 1}, files, findings);
  if (!options.complete(findings) || findings.hasErrors()) return exitWith(findings, kBadInput);
  const std::optional<StateFile> other = stateToCompare(o, findings);
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  auto player = Player::create(options, findings, printFindings);
  printFindings(findings);
  if (!player) return kBadInput;

  ShowParts parts = player->parts(StereoLayout::Off);
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    printHash(now.frame, scene.stateHash(), o.json);
  };
  ShowStages stages(std::move(parts));
  FrameLoopOptions loopOptions = player->loopOptions();
  if (loopOptions.frames == 0 && loopOptions.end == 0) loopOptions.frames = 600;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, loopOptions, never);
  const FrameLoopOutcome outcome = loop.run();
  if (!outcome.failure) return keepState(player->scene(), o, other);
  std::fprintf(stderr, "stadion: %s\n", outcome.failure->message.c_str());
  return exitCodeOf(*outcome.failure);
}

constexpr const char* kHashFooter =
    R"(A line is a hash of what changes while the show plays: poses, velocities, clocks, messages, alarms. Fields that follow
from these are left out. Equal lines mean that all of it is equal.

Parameters that never change, such as friction, gravity or the duration of a kick, are part of the files. They are not in
the hash. If one is edited, the lines differ from the frame on in which it has an effect. --compare-state compares
parameters too.

To find where two builds differ: compare their lines, then save the state of the first frame N that differs, and compare:

  other/stadion hash SHOW --frames N+1 --save-state there
  stadion hash SHOW --frames N+1 --compare-state there)";

}  // namespace

void addHashCommand(CLI::App& app, int& code) {
  auto options = std::make_shared<HashOptions>();
  CLI::App* command = app.add_subcommand(
      "hash", "Print the state hash of every frame, one line FRAME HEX16 each; draws nothing");
  addShowOptions(*command, options->show);
  CommandOptions own(*command);
  own.add("--save-state", options->saveState);
  own.add("--compare-state", options->compareState);
  own.add("--json", options->json);
  command->footer(kHashFooter);
  command->callback([options, &code] { code = hashShow(*options); });
}

}  // namespace stadion
