#include "tests/show/player/played_show.h"

#include "tests/programs/program.h"

namespace stadion {

std::unique_ptr<Player> openShow(const std::string& script, const std::string& walls) {
  ShowOptions options;
  options.script = script;
  options.walls = walls;
  options.size = "64x48";
  options.input = "none";
  options.assetRoots = {assetFolder()};
  Diagnostics findings;
  std::unique_ptr<Player> player;
  if (options.complete(findings)) player = Player::create(options, findings);
  printFindings(findings);
  return player;
}

FrameLoopOutcome play(ShowStages& stages, Mode mode, std::size_t walls, std::uint64_t frames, double rate) {
  FrameLoopOptions o;
  o.mode = mode, o.walls = walls, o.frames = frames, o.rate = rate;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  return loop.run();
}

void SteppedShow::play(std::uint64_t frames) {
  ShowParts parts = player->parts(StereoLayout::Off);
  for (const std::uint64_t end = next + frames; next < end; ++next) {
    const TimeSignature now = signatureAt(next, 60);
    parts.input.sampleFrame(now.time - now.step, now.time, input);
    player->scene().advance(now, input, changes, nullptr);
  }
}

}  // namespace stadion
