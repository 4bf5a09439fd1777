/// Plays 60 frames of a show without a window, says where a node is then, and saves what is seen on the first
/// wall.
///
///     play_show SHOW.evs NODE PICTURE.png

#include <stadion/engine/scene/placed_node.h>
#include <stadion/show/player.h>

#include <cstdio>

using namespace stadion;

namespace {

constexpr std::uint64_t kFrames = 60;

/// Keeps the last frame's picture.
class LastPicture final : public PictureSink {
public:
  bool wants(const TimeSignature& now) const override { return now.frame + 1 == kFrames; }
  Failure take(const TimeSignature&, const std::vector<EyePictures>& walls) override {
    picture_ = walls.front().eyes.front();
    return {};
  }
  const Picture& picture() const { return picture_; }

private:
  Picture picture_;
};

int fail(const std::string& why) {
  std::fprintf(stderr, "play_show: %s\n", why.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return fail("usage: play_show SHOW.evs NODE PICTURE.png");
  ShowOptions options;
  options.script = argv[1];
  options.walls = "desktop";
  options.size = "400x300";
  options.input = "none";
  options.frames = kFrames;
  Diagnostics findings;
  const bool usable = options.complete(findings);
  const std::unique_ptr<Player> player = usable ? Player::create(options, findings) : nullptr;
  for (const Diagnostic& d : findings.all()) std::fprintf(stderr, "%s\n", format(d).c_str());
  if (!player) return fail("the show cannot be played");

  const auto renderer = ShowRenderer::open({RendererChoice::Cpu});
  if (!renderer) return fail(format(renderer.error()));
  LastPicture sink;
  ShowParts parts = player->parts(StereoLayout::Off);
  renderer.value()->drawFor(parts);
  parts.sink = &sink;
  parts.drawUnseen = false;

  ShowStages stages(std::move(parts));
  const std::atomic<bool> stop = false;
  FrameLoop loop(stages, player->loopOptions(), stop);
  const FrameLoopOutcome outcome = loop.run();
  if (outcome.failure) return fail(outcome.failure->message);

  const Scene& scene = player->scene();
  // Names are looked up from the first node of the show's own script: load 1, node 0.
  constexpr NodeRef kFirst{1, 0};
  const NodeRef ref = scene.tree().resolve(argv[2], kFirst);
  const LoadedScene* load = scene.tree().load(ref.load);
  const auto* node = load ? dynamic_cast<const PlacedNode*>(load->nodes[ref.position].get()) : nullptr;
  if (!node) return fail(std::string("there is no node \"") + argv[2] + "\" with a place");
  const Pose X_WN = poseOf(scene.placements().world(node->placement()));
  std::printf("%s is at %.6f %.6f %.6f m after %llu frames\n", argv[2], X_WN.p.x(), X_WN.p.y(), X_WN.p.z(),
              static_cast<unsigned long long>(outcome.framesSimulated));

  if (const auto wrong = writePng(argv[3], sink.picture())) return fail(format(*wrong));
  std::printf("%s: %u x %u pixels\n", argv[3], sink.picture().width, sink.picture().height);
  return 0;
}
