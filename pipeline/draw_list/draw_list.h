#pragma once
/// What one wall draws in one frame, in all its views: filled by Cull, read by Draw, self-contained.
///
/// Frames   item matrices and light positions are relative to `origin`, a World point near the viewer, so
///          that single precision suffices anywhere in the world; axes are World's.
/// Ownership  plain values; a list may outlive the scene state it was made from. It refers to meshes by id.
/// Threads  one stage at a time owns it; but Draw may begin while Cull fills the items (list_filling.h).

#include "engine/asset/mesh_store.h"
#include "engine/display/wall.h"
#include "engine/maths/maths.h"
#include "engine/published/records.h"
#include "engine/published/shadow_places.h"
#include "pipeline/frame/frame_ticket.h"

#include <array>
#include <memory>
#include <vector>

namespace stadion {

class ListFilling;

/// A mesh to draw.
struct DrawItem {
  std::array<float, 12> model;  ///< (3 x 4), row major: mesh coordinates to World axes relative to origin
  MeshId mesh = kNoMesh;
  NodeRef owner;       ///< the node, for profiling
  float distance = 0;  ///< distance of the object's centre from the viewer [m]
  /// Number of pixels that the object's bounding sphere may cover in one view's picture, for profiling.
  float pixels = 0;
  std::uint32_t level = 0;   ///< 0 = all of the mesh; else Mesh::levels[level - 1]
  std::uint32_t figure = 0;  ///< number of the figure that it shows: DrawList::figures[figure - 1]; 0 = none
  std::uint32_t paint = 0;   ///< number of its paint: DrawList::paints[paint - 1]; 0 = none
  std::uint32_t views = kAllViews;  ///< views that may see the object: bit v stands for DrawList::views[v]

  static constexpr std::uint32_t kAllViews = ~0U;
};

struct DrawLight {
  enum class Kind : std::uint32_t { Directional, Point, Spot };
  Kind kind = Kind::Directional;
  std::array<float, 3> position{0, 0, 0};    ///< relative to origin [m]
  std::array<float, 3> direction{0, 0, -1};  ///< the way the light goes, unit
  std::array<float, 3> colour{1, 1, 1};      ///< linear, intensity included
  float range = 0;                   ///< distance at which the light has faded out [m]; 0 = it does not fade
  float cosInner = 1, cosOuter = 0;  ///< cosines of the spot's half angles
  bool shadows = false;              ///< directional: things stand in its way
  bool fallsOff = false;             ///< point, spot: with the square of the distance, beside its range
};

struct DrawSky {
  std::array<float, 3> zenith{0.18f, 0.36f, 0.72f};   ///< linear
  std::array<float, 3> horizon{0.66f, 0.76f, 0.85f};  ///< linear
  std::array<float, 3> ground{0.28f, 0.26f, 0.22f};   ///< linear, below the horizon
  std::array<float, 3> ambient{0.25f, 0.27f, 0.30f};  ///< linear, light from everywhere
  float hazeDistance = 0;                             ///< where 63 % is haze [m]; 0 = none
  EnvironmentRecord environment{};
  TonesRecord tones{};
};

constexpr std::uint32_t kShadowTexels = 1024;  ///< a side of a ring of the shadow maps
constexpr double kShadowDepth = 600;  ///< reach of a ring along the light, from its middle either way [m]

/// A square across the light, and what casts shadows into it. Matrices are relative to the ring's middle.
struct DrawShadowRing {
  std::array<float, 3> offset{};  ///< offset of the list's origin from the ring's middle, along the axes [m]
  /// Objects that stand still; shared by all walls, null = none.
  std::shared_ptr<const std::vector<DrawItem>> still;
  std::vector<DrawItem> moving;
  std::uint64_t stillKey = 0, movingKey = 0;  ///< follow from what casts and from where the ring is
  /// Area that moving objects cover: least x, y, greatest x, y; the ring is -1 .. 1.
  std::array<float, 4> movingArea{1, 1, -1, -1};
};

/// The light whose shadows are drawn, and the rings from the nearest, finest one outwards.
struct DrawShadows {
  std::int32_t light = -1;      ///< index of the light in the list; -1 = there are no shadows
  std::array<float, 9> axes{};  ///< (3 x 3), rows: right, up, towards the light; in World
  std::array<DrawShadowRing, kShadowRings> rings;
};

/// The camera of a view.
struct DrawView {
  Mat4 view = Mat4::Identity();        ///< World axes relative to origin, to eye coordinates (looks along -z)
  Mat4 projection = Mat4::Identity();  ///< eye to clip; z in [0, w], w at the near plane, 0 at the far one
  Eye eye = Eye::Left;                 ///< eye that the picture is for; Left also for a view from the middle
};

struct DrawList {
  static constexpr std::size_t kMostViews = 8;  ///< limit of the views of a wall
  static constexpr std::size_t kMaxLights = 16;
  static constexpr std::size_t kPortion = 1024;  ///< Draw takes opaque items up by so many

  FrameTicket ticket;
  std::uint32_t wall = 0;
  ListFilling* filling = nullptr;  ///< how far that has come; null = all is there
  Vec3 origin = Vec3::Zero();      ///< in World [m]
  std::array<DrawView, kMostViews> views;
  std::uint32_t viewCount = 2;
  ViewerRecord viewer;  ///< from where it is seen
  DrawSky sky;
  std::vector<DrawLight> lights;      ///< at most kMaxLights
  std::vector<FigureRecord> figures;  ///< what each of the show's figures plays
  std::vector<PaintRecord> paints;    ///< the paints of the show
  DrawShadows shadows;
  /// Sorted by mesh and level, then by the sum of the first and the last view that see them, then near to
  /// far. So what one of two views sees lies together.
  std::vector<DrawItem> opaque;
  /// Items with any transparent material, in an order that does not depend on the viewer. Where surfaces lie
  /// at the same depth, the later one is in front.
  std::vector<DrawItem> transparent;
};

}  // namespace stadion
