#pragma once
/// The stages of a real show: the scene, its published state, the walls and their pictures.

#include "engine/input/input_device.h"
#include "engine/scene/scene.h"
#include "pipeline/cull/cull.h"
#include "pipeline/draw_list/draw_counts.h"
#include "pipeline/draw_list/renderer.h"
#include "pipeline/loop/head_latch.h"
#include "pipeline/loop/head_timing.h"
#include "pipeline/loop/swap_forecast.h"
#include "pipeline/operator/operator_controls.h"
#include "pipeline/picture/picture.h"
#include "pipeline/platform/draw_pool.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/sound/sound_sink.h"
#include "pipeline/state/scene_state.h"
#include "pipeline/target/target.h"
#include "pipeline/wall/stages.h"
#include "pipeline/wall/wall_contexts.h"
#include "pipeline/wall/wall_renderer.h"

#include <array>
#include <atomic>
#include <functional>
#include <vector>

namespace stadion {

class PatternPictures;

/// The pictures of a wall in a frame, by view: left and right, or one for both.
struct EyePictures {
  std::uint64_t frame = 0;
  std::vector<Picture> eyes;
};

/// Takes finished frames: files, hashes, a video, a window.
///
/// Threads  take() on the Draw thread that arrived last, while the others wait; it should hand on and return.
class PictureSink {
public:
  virtual ~PictureSink() = default;
  /// Returns true if the pictures of this frame are wanted: reading them back costs time. Any thread.
  virtual bool wants(const TimeSignature& now) const = 0;
  /// Returns true if those of this wall are. take() gets older pictures of walls that it does not want. Any thread.
  virtual bool wantsWall(const TimeSignature& now, std::size_t /*wall*/) const { return wants(now); }
  virtual Failure take(const TimeSignature& now, const std::vector<EyePictures>& walls) = 0;
};

/// Called with the scene after each App stage, on the App thread.
using AppObserver = std::function<void(const TimeSignature&, const InputSample&, const Scene&)>;

/// Wall processes draw the walls (process/per_wall_process_renderer.h).
struct WallProcesses {
  RendererKind renderer = RendererKind::OsMesa;
  /// Rasteriser threads of each process; at least one for the CPU renderer.
  std::uint32_t rasteriserThreads = 0;
  /// True: every frame counts. False: the newest frame counts, and no wall waits for a late one.
  bool everyFrame = true;
  double rate = 60;                                ///< [1/s]
  std::function<void(const std::string&)> tell{};  ///< receives reports about processes; on Draw threads
};

/// Returns what a view of the wall means for levels of detail.
WallPixels wallPixelsOf(const WallViews& wall, const View& view);

/// The arguments of ShowStages. It has more than 20 fields, because each is an argument, most with a default.
struct ShowParts {
  Scene& scene;
  SceneState& state;
  MeshStore& meshes;
  InputDevice& input;
  std::vector<WallViews> walls;
  GlProvider* provider = nullptr;  ///< OpenGL draws in this process; null: it does not
  DrawPool* pool = nullptr;        ///< the CPU renderer draws in this process; without both nothing is drawn
  PictureSink* sink = nullptr;
  WallContexts* contexts = nullptr;  ///< contexts that outlive the show; null: it makes its own
  bool drawUnseen = true;            ///< false: draws only frames that the sink wants, and the last one
  AppObserver observer;
  /// Called in each App stage with the newest frame that all walls have shown. It frees what no later frame
  /// draws.
  std::function<void(std::uint64_t)> freeUnshown{};
  /// Returns the models that scripts make transparent, for the warm-up; on Draw threads.
  std::function<std::vector<MeshId>()> fading{};
  FrameProbe* probe = nullptr;
  /// Once it returns true, Draw stops and the run ends. Any thread; null = never.
  std::function<bool()> giveUp{};
  std::function<void()> shown{};  ///< called when all walls have shown a frame, on the Draw thread that
                                  ///< swaps
  SoundSink* sounds = nullptr;  ///< null: no sound
  const OperatorControls* controls = nullptr;  ///< null: no operator
  PatternPictures* patterns =
      nullptr;                   ///< shown while the operator wants the test pattern; null: there are none
  bool waitsForPatterns = true;  ///< false: walls show the show until their patterns have been made
  RenderQuality quality{};
  std::optional<WallProcesses> wallProcesses{};  ///< draw instead of this process
  std::vector<WallPixels> otherWalls{};  ///< walls of the room that other hosts draw: detail levels are
                                         ///< chosen for all walls
  /// By wall: its processors; empty: any. Expects a thread or a process for each wall.
  std::vector<ProcessorSet> processors{};
  HeadTiming head{};  ///< the walls' views must have its reach, too
  /// Receives reports about walls that this process draws; on Draw threads.
  std::function<void(const std::string&)> tell{};
};

/// Counts of frames in which a wall kept an older picture because the new one was late.
struct WallLateness {
  std::uint64_t frames = 0, inARow = 0;  ///< in all; at most in a row
};

class ShowStages final : public Stages {
public:
  explicit ShowStages(ShowParts parts);
  ~ShowStages() override;

  void app(const TimeSignature& now, std::size_t slot) override;
  void still(const TimeSignature& now, std::size_t slot) override;
  bool wantsDrawn(const FrameTicket& ticket) const override;
  void cull(std::size_t wall, std::size_t slot, DrawList& list) override;
  std::optional<std::chrono::steady_clock::time_point> headMeasured() const override { return measured_; }
  std::optional<std::chrono::steady_clock::time_point> posed(std::size_t wall) const override;
  void latch(std::size_t wall, DrawList& list) override;
  Failure openWall(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  Failure draw(std::size_t wall, const DrawList& list) override;
  void closeWall(std::size_t wall) override;
  Failure swap(const TimeSignature& now) override;

  /// Returns the pictures of the frame drawn last, with its number. For use after the run.
  const std::vector<EyePictures>& lastPictures() const { return pictures_; }
  /// Returns the totals of a wall, by view. For use after the run.
  const ViewTotals& drawn(std::size_t wall) const { return drawn_[wall].totals; }
  std::string drawnBy() const { return drawnBy_; }
  /// For use after the run.
  const WallLateness& late(std::size_t wall) const { return drawn_[wall].late; }
  /// Returns the counts of late latch; null without late latch. For use after the run.
  const LatchCounts* latched() const { return latch_ ? &latch_->counts() : nullptr; }
  /// Returns the current prediction, as time after a frame's start [ns]. Any thread.
  Nanoseconds aimedAt() const;

private:
  /// The last picture of a wall.
  struct Drawn {
    std::uint32_t views = 0;
    std::uint64_t frame = 0;
    bool read = false;    ///< the pictures have been read back
    ViewTotals totals{};  ///< totals of the whole show, set when the wall is closed
    std::optional<std::chrono::steady_clock::time_point> posed{};  ///< the head's pose was measured then
    WallLateness late{};
    std::uint64_t lateNow = 0;  ///< frames in a row, up to this one
    /// Of a projector: the matrices from the rig to each view, and the views' pictures.
    std::array<Mat4, DrawList::kMostViews> clipFromRig{};
    std::vector<Picture> facets{};
  };

  void tellPublished();
  void playSounds(const InputSample& input, bool still);
  void noteMeasured(const InputSample& input);
  Failure readPictures(std::size_t wall);
  bool showPattern(std::size_t wall, const Presentation& shown);
  Failure readViews(std::size_t wall, std::vector<Picture>& pictures);
  void project(std::size_t wall);

  ShowParts parts_;
  InputSample input_;  ///< input of App's current frame
  ChangeSet changes_;
  bool published_ = false;  ///< the scene, whole
  StillCasters stillCasters_;
  std::vector<WallPixels> wallPixels_;  ///< pictures of the walls with the visitor's view
  RoomCull room_;
  std::vector<WallCull> culls_;  ///< by wall, each used by its Cull only
  SoundScape heard_;
  std::unique_ptr<WallRenderer> wallRenderer_;  ///< null draws nothing
  std::vector<Drawn> drawn_;                    ///< by wall
  std::vector<EyePictures> pictures_;
  std::optional<HeadLatch> latch_;
  SwapForecast swaps_;
  /// Time at which the head pose of App's current frame was measured.
  std::optional<std::chrono::steady_clock::time_point> measured_;
  std::atomic<std::chrono::steady_clock::time_point> began_{};  ///< the frame that is drawn now
  std::atomic<std::uint64_t> shownFrame_ = 0;  ///< the newest frame that all walls have shown
  std::string drawnBy_;
};

}  // namespace stadion
