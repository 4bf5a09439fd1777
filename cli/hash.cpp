/// `stadion hash SHOW`: the state hash of every frame, nothing drawn.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/show_options.h"
#include "cli/terminal.h"
#include "show/player/player.h"

#include <CLI/CLI.hpp>
#include <cinttypes>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

int hashShow(ShowOptions options) {
  Diagnostics findings;
  if (!options.settle(findings)) return tell(findings), kBadInput;
  auto player = Player::create(options, findings, tell);
  tell(findings);
  if (!player) return kBadInput;

  ShowParts parts = player->parts(StereoLayout::Off);
  const ShowStages* running = nullptr;
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    std::printf("%" PRIu64 " %016" PRIx64 "\n", now.frame, scene.stateHash());
    player->collect(running->shownFrame());
  };
  ShowStages stages(std::move(parts));
  running = &stages;
  FrameLoopOptions loopOptions = player->loopOptions();
  if (loopOptions.frames == 0 && loopOptions.end == 0) loopOptions.frames = 600;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, loopOptions, never);
  const FrameLoopOutcome outcome = loop.run();
  if (!outcome.failure) return kOk;
  std::fprintf(stderr, "stadion: %s\n", outcome.failure->message.c_str());
  return exitCodeOf(*outcome.failure);
}

}  // namespace

void addHashCommand(CLI::App& app, int& code) {
  auto options = std::make_shared<ShowOptions>();
  CLI::App* command = app.add_subcommand(
      "hash", "Print the state hash of every frame, one line FRAME HEX16 each; draws nothing");
  addShowOptions(*command, *options);
  command->callback([options, &code] { code = hashShow(*options); });
}

}  // namespace stadion
