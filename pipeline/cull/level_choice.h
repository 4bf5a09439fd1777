#pragma once
/// Chooses the simplified level of a mesh that is drawn: the coarsest one with an invisible error.
///
/// A level is off the full surface by at most e [m]. Seen from a distance d at an angle theta from a wall's
/// normal, that is at most
///
///     e / d x D / (p cos^2 theta)   pixels
///
/// where D is the head's distance from the wall and p the size of its pixels [m]. The level may be off by one
/// pixel. d is measured to the nearest point of the mesh's box, theta is the greatest at which any part of
/// the object can be seen on that wall, and of all walls the strictest counts: so the choice is the same on
/// all walls and for both eyes. Under stress, and where an object has to do with less detail, it counts as
/// farther away.
///
/// Threads  one wall's Cull; the walls and the meshes must outlive it, and the viewer the frame.

#include "engine/asset/mesh_store.h"
#include "engine/display/wall.h"
#include "engine/published/records.h"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace stadion {

/// A wall of the show, as far as it matters to levels.
struct WallPixels {
  Wall wall;
  std::uint32_t width = 0, height = 0;  ///< size of one eye's picture [pixels]
  bool around = false;                  ///< of a panorama: `wall` is relative to the eye
  std::optional<Vec3> at{};             ///< place of a panorama's eye, in R [m]; none: the head's
};

class LevelChoice {
public:
  static constexpr double kMostPixels = 1;

  /// Borrows both.
  LevelChoice(std::span<const WallPixels> walls, const MeshStore& meshes)
      : wallPixels_(walls), meshes_(meshes) {}

  /// From here, in the frame that follows.
  void setViewer(const ViewerRecord& viewer);
  /// 0 = the full surface; else it is Mesh::levels[that - 1]. Expects that setViewer() has been called.
  std::uint32_t levelOf(const InstanceRecord& record);

private:
  struct Seen {
    bool elsewhere = false;  ///< the eye is not at the head
    Vec3 from;               ///< the eye, from the head; in World [m]
    Vec3 towards;            ///< the wall's foot below the eye, from the eye; in World, unit
    double pixels = 0;       ///< D / p, of one radian in the wall's middle
    double mostAngle = 0;    ///< angle of the farthest corner of the wall from `towards`
  };

  const Mesh* mesh(MeshId id);
  double pixelsOf(const Vec3& centre, double radius) const;

  void lookAtWalls();

  const ViewerRecord* viewer_ = nullptr;
  std::span<const WallPixels> wallPixels_;
  Vec3 head_ = Vec3::Zero();
  std::vector<Seen> walls_;  ///< once there is a level to choose
  const MeshStore& meshes_;
  std::vector<std::pair<MeshId, const Mesh*>> known_;  ///< meshes that this frame has asked for, by id
};

}  // namespace stadion
