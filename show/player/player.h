#pragma once
/// A show with all its parts: script, walls, input, scene and loader. ShowStages borrows them.
///
/// Size     Player has more than 20 fields: each of these parts is one, in the order in which they need each
///          other.

#include "dynamics/nodes/body_maker.h"
#include "engine/asset/import.h"
#include "engine/build/builder.h"
#include "engine/display/wall_file.h"
#include "engine/input/input_device.h"
#include "engine/input/operator_device.h"
#include "engine/input/run_decisions.h"
#include "engine/scene/scene.h"
#include "engine/script/script_texts.h"
#include "pipeline/load/loader.h"
#include "pipeline/loop/frame_loop.h"
#include "pipeline/loop/show_stages.h"
#include "pipeline/picture/stereo.h"
#include "pipeline/projection/pattern_pictures.h"
#include "pipeline/shader/look.h"
#include "show/base/standard_nodes.h"

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stadion {

/// Which show is played, on which walls, and for how long.
struct ShowOptions {
  std::string script;
  std::string walls = "cave4";
  Mode mode = Mode::Pipelined;
  Look look = Look::Full;
  std::uint32_t samples = 0;  ///< for each pixel: 1, 2, 4 or 8; 0 = 4, or 1 in the plain look
  std::string size;           ///< empty = as the wall file says, else 800x600
  double rate = 60;
  bool rateGiven = false;    ///< true: `rate` was given; false: a recorded run's own rate overrides it
  std::uint64_t frames = 0;  ///< 0 = by `seconds`
  double seconds = 0;        ///< 0 = to the end of the input
  std::string input;         ///< empty = beside the script if there is one; "none"
  std::vector<std::string> assetRoots;
  /// The walls of the room that are drawn here; empty = all.
  std::vector<std::string> onlyWalls;
  bool isDrawn = true;  ///< false: a hall's projectors get no projections, which take seconds to make
  std::vector<std::string> plugins;     ///< files of node types, which `types` holds
  SharedTypes types = standardNodes();  ///< node types that the scripts may use
  std::size_t appThreads = 0;           ///< 0 = as many as there are processors, 8 at most
  DynamicsVariation variation;          ///< variation of the script's models
  /// The scripts that are played; null: as they are on disk when the show is opened.
  std::shared_ptr<const ScriptTexts> texts;
  /// The snapshot that the show continues from (SceneSnapshot::save()); null: it starts from the beginning.
  std::shared_ptr<const std::vector<std::uint8_t>> state;

  std::uint32_t width = 0, height = 0;  ///< from `size`

  /// The folders of the show's files: the script's own, and those of `assetRoots` that exist.
  AssetRoots roots() const;
  /// Completes the members that depend on others. False, with the reason in the findings, if one is wrong.
  bool complete(Diagnostics& findings);
};

/// Everything of a show but its drawing.
///
/// Ownership  owns its parts, but not the `kept` models and not a live input device: these must outlive it.
class Player {
public:
  /// Reads, checks and loads everything. Null if a file or an option is wrong; the findings say what.
  /// Errors and warnings of files that are loaded, now and during the show, go to `report`, if there is one.
  /// Once `stop` is true, the player no longer waits for files. Models `kept` from an earlier show are not
  /// imported again; they must outlive the player. The scripts are those of that moment, also those of
  /// sub-scenes that are loaded later.
  static std::unique_ptr<Player> create(const ShowOptions& options, Diagnostics& findings,
                                        std::function<void(const Diagnostics&)> report = {},
                                        const std::atomic<bool>* stop = nullptr,
                                        ImportedMeshes* kept = nullptr);
  /// Makes a player in two steps: all but the scene, then the scene. Only the second step reads the show's
  /// files. A player whose scene could not be opened is of no use.
  static std::unique_ptr<Player> prepare(const ShowOptions& options, Diagnostics& findings,
                                         std::function<void(const Diagnostics&)> report,
                                         const std::atomic<bool>* stop, ImportedMeshes* kept);
  bool openScene(Diagnostics& findings);
  ~Player();

  /// Frames to play: as asked, or to the end of the input log; 0 = until stopped.
  std::uint64_t frames() const { return frames_; }
  /// Show time at which the input log ends, unless the number of frames was asked for; 0 = none.
  Nanoseconds end() const { return end_; }
  /// Frames a second: as asked, else as the input log was recorded.
  double rate() const { return rate_; }
  /// Returns true if the input log holds what a clock decided: then every frame is played as it was recorded.
  bool replaysLog() const { return !decisions_.empty(); }
  bool inputFound() const { return inputFound_; }
  /// Mode, rate, walls, length, and what the input log decided. Plays every frame, as fast as possible.
  FrameLoopOptions loopOptions() const;
  /// Files that come late do not hold up the show. Before the first frame.
  void playLive() { loader_->playLive(); }
  /// The loads that were due when the run ended and had not taken effect.
  std::vector<std::uint32_t> overdueLoads() const { return loader_->overdue(); }
  /// Calls `report` on the App thread with each file that came late. To be called before the first frame.
  void tellLateLoads(Loader::LateLoad report) { loader_->tellLateLoads(std::move(report)); }
  /// Calls `report` with true when the App thread begins to wait for files, and with false when it has them.
  /// To be called before the first frame.
  void tellWaiting(std::function<void(bool)> report) { loader_->tellWaiting(std::move(report)); }
  const RunDecisions& decisions() const { return decisions_; }
  const WallFile& walls() const { return walls_; }
  Scene& scene() { return *scene_; }
  const AssetRoots& assets() const { return roots_; }
  MeshStore& meshes() { return *meshes_; }
  const std::string& inputName() const { return inputName_; }
  const std::string& script() const { return options_.script; }

  /// The parts for a ShowStages; provider and sink are the caller's to add. `input`: instead of input().
  ShowParts parts(StereoLayout stereo, InputDevice* input = nullptr);
  /// Where the show's input comes from.
  InputDevice& input() { return operator_ ? *operator_ : visitor(); }
  /// From now on the input is what this device says, not the log's. Before the first frame.
  void takeInputFrom(InputDevice& device) {
    live_ = &device;
    if (operator_) operator_->readFrom(device);
  }
  /// The operator calls a cue of the show. Returns false if the show had no cue when it was opened. Any thread.
  bool callCue(std::uint32_t number) { return operator_ && operator_->call(number); }
  bool inputIsLive() const { return live_ != nullptr; }

private:
  Player();
  InputDevice& visitor() { return live_ ? *live_ : *input_; }
  bool openInput(Diagnostics& findings);
  void computeLength();
  bool project(WallFile& room, Diagnostics& findings);
  void takeWalls(WallFile room);
  WallViews viewsOfEntry(const WallEntry& entry, bool stereo) const;
  PixelSize pixelsOf(const WallEntry& entry) const;

  SharedTypes types_;
  NodeServices services_;
  MeshStore ownMeshes_;
  MeshStore* meshes_ = &ownMeshes_;
  SceneState state_;
  AssetRoots roots_;
  std::unique_ptr<Importer> importer_;
  std::unique_ptr<Loader> loader_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<InputDevice> input_;
  InputDevice* live_ = nullptr;             ///< used instead of input_, if there is one
  std::optional<OperatorDevice> operator_;  ///< adds the operator's cues to the input, if the show has any
  WallFile walls_;                          ///< walls that are drawn here
  std::vector<WallEntry> others_;           ///< the room's others
  std::map<std::string, std::shared_ptr<const Projection>> projections_;  ///< by name of the projector
  ShowOptions options_;
  RunDecisions decisions_;
  double rate_ = 60;
  std::uint64_t frames_ = 0;
  Nanoseconds end_ = 0;
  bool inputFound_ = false;
  std::string inputName_;
  std::vector<std::string> trackers_;  ///< trackers that the input log names
  std::unique_ptr<PatternPictures> patterns_;
};

}  // namespace stadion
