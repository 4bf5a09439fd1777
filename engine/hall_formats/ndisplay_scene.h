#pragma once
/// What both kinds of nDisplay files say: a tree of transforms, screens, view points and viewports.
///
/// Frames     Unreal's there (+X forward, +Y right, +Z up, left-handed), the rig's in what build() makes.
/// Units      metres, degrees.
/// Ownership  borrows the HallBuilder.

#include "engine/hall_formats/hall_builder.h"
#include "engine/hall_formats/neighbour_files.h"

#include <map>
#include <string>

namespace stadion {

struct NdisplayTransform {
  std::string parent;
  Vec3 location = Vec3::Zero();         ///< in the parent's axes [m]
  double pitch = 0, yaw = 0, roll = 0;  ///< up, to the right, clockwise [degrees]
  double width = 0, height = 0;         ///< of a screen [m]
  double eyeSeparation = 0;             ///< of a view point [m]
};

struct NdisplayViewport {
  std::string name, place, viewPoint, policy;
  std::map<std::string, std::string> parameters;
  WallEntry entry;         ///< with its pixels and output
  std::uint32_t line = 0;  ///< in a .cfg file
};

class NdisplayScene {
public:
  NdisplayScene(HallBuilder& builder, const NeighbourFiles& files) : builder_(builder), files_(files) {}

  std::map<std::string, NdisplayTransform> transforms;  ///< with screens and view points, by name
  std::vector<NdisplayViewport> viewports;

  /// Makes walls and projectors of the viewports.
  void build();

private:
  struct Axes {
    Mat3 unreal = Mat3::Identity();  ///< columns: the axes, in the root's
    Vec3 origin = Vec3::Zero();
  };

  std::optional<Axes> axesOf(const std::string& name, const NdisplayViewport& viewport);
  void buildScreen(NdisplayViewport& viewport, const std::string& screen);
  void buildMpcdi(NdisplayViewport& viewport);
  void buildPfm(NdisplayViewport& viewport, const std::string& file);
  void leaveOut(const NdisplayViewport& viewport, const std::string& why);
  void nameRest(const NdisplayViewport& viewport, std::initializer_list<std::string_view> known);

  HallBuilder& builder_;
  const NeighbourFiles& files_;
};

}  // namespace stadion
