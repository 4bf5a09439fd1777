#include "cli/player.h"

#include "dynamics/nodes/dynamics_factories.h"
#include "engine/input/input_log.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace stadion {
namespace {

/// Nobody is there: no tracker says anything.
class NoInput final : public InputDevice {
public:
  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override {
    sample.time = showTime;
    sample.trackers.clear();
  }
};

bool parseSize(const std::string& text, std::uint32_t& width, std::uint32_t& height) {
  char rest = 0;
  return std::sscanf(text.c_str(), "%ux%u%c", &width, &height, &rest) == 2 && width >= 1 && height >= 1 &&
         width <= 16384 && height <= 16384;
}

}  // namespace

void tell(const Diagnostics& findings) {
  for (const Diagnostic& d : findings.all()) std::fprintf(stderr, "%s\n", format(d).c_str());
}

void ShowOptions::addTo(CLI::App& command) {
  command.add_option("SHOW", script, "the script to play (.evs)")->required();
  command.add_option("--walls", walls, "cave4, cave6, powerwall, desktop, or a wall file of your own")
      ->capture_default_str();
  command
      .add_option("--mode", mode, "pipelined (App, Cull and Draw overlap) or sequential: the same pictures")
      ->check(CLI::IsMember({"pipelined", "sequential"}))
      ->capture_default_str();
  command.add_option(
      "--size", size,
      "WIDTHxHEIGHT in pixels of one eye's picture (default: what the wall file says, else 800x600)");
  command.add_option("--rate", rate, "frames per second of show time")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  command.add_option("--frames", frames, "stop after so many frames")->check(CLI::NonNegativeNumber);
  command.add_option("--seconds", seconds, "stop after so much show time")->check(CLI::PositiveNumber);
  command.add_option("--input", input,
                     "input log to replay (default: SHOW's name with .input, if there is one), or none");
  command.add_option("--asset-root", assetRoots, "further folder to look for assets in");
}

bool ShowOptions::settle(Diagnostics& findings) {
  if (!parseSize(size.empty() ? "800x600" : size, width, height))
    findings.error({}, "--size: \"" + size +
                           "\" is not WIDTHxHEIGHT in pixels from 1x1 to 16384x16384, such as 800x600");
  if (frames == 0 && seconds > 0) frames = static_cast<std::uint64_t>(std::ceil(seconds * rate)) + 1;
  return !findings.hasErrors();
}

Player::Player() = default;
Player::~Player() = default;

std::unique_ptr<Player> Player::create(const ShowOptions& options, Diagnostics& findings,
                                       std::function<void(const Diagnostics&)> report) {
  namespace fs = std::filesystem;
  std::unique_ptr<Player> player(new Player);
  Player& p = *player;
  p.options_ = options;

  auto walls = loadWalls(options.walls, std::string(STADION_ROOT) + "/walls", findings);
  if (!walls) return nullptr;
  p.walls_ = std::move(*walls);

  std::string input = options.input;
  if (input.empty()) {
    const fs::path beside = fs::path(options.script).replace_extension(".input");
    input = fs::exists(beside) ? beside.string() : "none";
  }
  if (input == "none") {
    p.input_ = std::make_unique<NoInput>();
  } else {
    auto log = loadInputLog(input, findings);
    if (!log) return nullptr;
    p.input_ = std::make_unique<InputReplay>(std::move(*log));
    p.inputFound_ = true;
    p.inputName_ = input;
  }
  p.frames_ = options.frames;
  if (p.frames_ == 0) p.end_ = p.input_->end();
  if (p.frames_ == 0 && p.inputFound_)
    p.frames_ = static_cast<std::uint64_t>(std::ceil(toSeconds(p.input_->end()) * options.rate)) + 1;

  p.roots_ = AssetRoots::ofScript(options.script);
  AssetRoots forImporter = AssetRoots::ofScript(options.script);
  for (const std::string& root : options.assetRoots)
    if (!p.roots_.add(root) || !forImporter.add(root))
      findings.error({}, "--asset-root: cannot open the folder " + root);
  if (findings.hasErrors()) return nullptr;

  addEngineFactories(p.factories_);
  addDynamicsFactories(p.factories_);
  p.importer_ = std::make_unique<Importer>(Importer::programBesideThis(), std::move(forImporter));
  p.loader_ = std::make_unique<Loader>(
      LoaderParts{p.meshes_, p.state_.arena(), *p.importer_, p.roots_, p.factories_, std::move(report)});
  p.scene_ = std::make_unique<Scene>(*p.loader_, p.meshes_);
  if (!p.scene_->open(options.script)) return nullptr;
  return player;
}

ShowParts Player::parts(StereoLayout stereo) {
  ShowParts parts{*scene_, state_, meshes_, *input_, {}, nullptr, nullptr, true, {}, nullptr};
  for (const WallEntry& entry : walls_.walls) {
    WallView view;
    view.wall = entry.wall;
    view.depth = walls_.depth;
    view.eyeSeparation = walls_.eyeSeparation;
    view.stereo = eyeCount(stereo) == 2;
    // What the user says on the command line counts, else what the wall file says, else the standard size.
    const bool byFile = options_.size.empty() && entry.pixels.width > 0;
    view.width = byFile ? entry.pixels.width : options_.width;
    view.height = byFile ? entry.pixels.height : options_.height;
    parts.walls.push_back(view);
  }
  return parts;
}

}  // namespace stadion
