#pragma once
/// Views: the pictures of a frame.
///
/// A view is a frustum with a target. The frustum runs from an eye through the corners of a screen. The
/// target is a picture of the wall that shows the view. A show has any number of views.
///
/// A wall groups views that share work: Cull finds what all of them see in one pass and writes one draw list,
/// and Draw draws them one after the other in one context. A flat wall has a view for each eye. A projector
/// onto a curved screen has one for each flat part of it, through screens of their own.
///
/// Frames   R is the rig, World axes relative to an origin near the viewer.
/// Threads  plain values and pure functions.

#include "engine/display/frustum.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/view/free_camera.h"
#include "pipeline/view/head_reach.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class Projection;

/// From where the visitor looks through a screen.
enum class ViewPoint : std::uint32_t { Left, Right, Middle };

struct View {
  Wall screen;  ///< in R
  ViewPoint from = ViewPoint::Middle;
};

/// Returns true if they have the same corners.
bool isSameScreen(const Wall& a, const Wall& b);

/// Returns the views of a flat wall: one for each eye, or one from the middle.
std::vector<View> viewsOf(const Wall& screen, bool stereo);
/// Returns the views of a projector: its facets one after the other, each for the eyes that it serves. Those of a
/// panorama are from one eye, and their screens are relative to it.
std::vector<View> viewsOf(const Projection& projection, bool stereo);

struct WallViews {
  std::string name{};
  std::vector<View> views{};  ///< 1 to DrawList::kMostViews
  DepthRange depth{};
  double eyeSeparation = 0.064;             ///< [m]
  std::uint32_t width = 800, height = 600;  ///< size of the picture of each view [pixels]
  const FreeCamera* camera = nullptr;       ///< looks in place of the visitor; `views` is one, and not used
  HeadReach reach{};                        ///< how far the visitor's head may go after Cull
  /// Makes the output's pictures from those of the views; null: they are the same.
  std::shared_ptr<const Projection> projection{};
  std::optional<std::uint32_t>
      card{};  ///< graphics card that draws it (GlProvider); none: the provider's choice
};

/// How the operator wants the eyes of all walls.
struct EyeChoice {
  double separation = -1;  ///< [m]; negative: as each wall has it
  bool swapped = false;    ///< the left eye looks in place of the right one
};

/// The views of a wall in one frame. Borrows their screens.
struct PlacedViews {
  struct Placed {
    const Wall* screen = nullptr;
    Vec3 eye = Vec3::Zero();  ///< in R [m]
    Eye picture = Eye::Left;  ///< eye that the picture is for; Left also for a view from the middle
  };
  std::array<Placed, DrawList::kMostViews> views;
  std::uint32_t count = 0;
  DepthRange depth;
  Pose X_WR;                   ///< of a panorama: places its eye in World
  Vec3 origin = Vec3::Zero();  ///< where the head is, in World [m]
  double margin = 0;           ///< how far each eye may go [m]
  bool around = false;         ///< a panorama: its screens go with its eye

  /// The end of the views from number `first` on that look through the same screen.
  std::uint32_t endOfScreen(std::uint32_t first) const;
  /// Returns the volume that the views first .. end can see together, wherever their eyes go, relative to the
  /// origin. Expects that they look through the same screen.
  ConvexVolume volume(std::uint32_t first, std::uint32_t end) const;
  void setUp(DrawList& list) const;
};

/// Returns the matrix from R to the clip coordinates of a view of the list.
Mat4 clipFromRig(const DrawList& list, std::uint32_t view);

/// Where the views of a wall are for this viewer, or the camera's if it looks. Borrows the wall and `camera`.
/// Frames: those of a panorama are relative to its eye, which stands still in them.
PlacedViews place(const ViewerRecord& viewer, const WallViews& wall, const EyeChoice& choice,
                  const CameraView* camera = nullptr);

}  // namespace stadion
