#pragma once
/// The scenes of `stadion bench looks`: moments of shows and of the scenes of `stadion bench walls`, and the
/// draw lists of their walls.
///
/// Threads  the thread that calls; the show's own threads only wait.

#include "pipeline/draw_list/draw_list.h"
#include "show/base/temporary_folder.h"
#include "show/player/player.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct LooksScene {
  std::string_view name;    ///< as it is chosen
  std::string_view script;  ///< in the folder scripts; empty: a scene of `bench walls`, or the filled stadium
  std::vector<std::string> walls;  ///< walls of the room; flicker is measured on the last one
  double seconds;                  ///< show time of the moment
};

/// All scenes. Those of one script follow each other, in the order of their moments.
const std::vector<LooksScene>& allLooksScenes();
/// Their names, for the grammar of an option.
constexpr std::string_view kLooksSceneNames =
    "kick|olympia-1|olympia-2|olympia-3|olympia-4|olympia-5|olympia-6|filled|crowd|a|b|c";

/// A show with its recorded input, played frame by frame without being drawn.
class LooksShow {
public:
  /// Null, with the findings, if the show cannot be opened.
  static std::unique_ptr<LooksShow> open(const LooksScene& scene, const std::string& size,
                                         Diagnostics& findings);

  /// Plays up to the first frame that is not before this time. Expects a time that has not passed.
  void playTo(double seconds);
  void playFrame();
  /// The list of one of the scene's walls, both eyes, in the current frame.
  DrawList listOf(const std::string& wall);

  const MeshStore& meshes() { return player_->meshes(); }
  PixelSize size() const { return size_; }
  double seconds() const { return toSeconds(now_.time); }

private:
  LooksShow() = default;
  std::string writeScene(const LooksScene& scene, ShowOptions& options) const;

  TemporaryFolder folder_;  ///< files of a scene without a script of its own
  std::unique_ptr<Player> player_;
  std::unique_ptr<ShowStages> stages_;
  PixelSize size_;
  TimeSignature now_;
  std::uint64_t frames_ = 0;  ///< played so far
};

}  // namespace stadion
