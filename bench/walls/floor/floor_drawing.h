#pragma once
/// The least cost of drawing a view: visibility is known beforehand, and only OpenGL is called.
///
/// Frames   World +Z up; an eye looks along -Z.
/// Threads  the thread that has the OpenGL context.
/// Errors   shaders that do not compile end the program.

#include "bench/walls/wall_room.h"

#include <optional>
#include <string>

namespace stadion::bench {

enum class FloorWay {
  Clear,      ///< nothing but the background
  Uniform,    ///< a draw for each visible node, sorted by mesh, its matrix in a uniform: STRICT
  Discard,    ///< as Uniform, without rasterising
  Instanced,  ///< a draw for each mesh
  Merged,     ///< one draw for all: corners in the eye's coordinates, made beforehand
};
std::optional<FloorWay> floorWay(const std::string& name);

/// A view, ready to be drawn.
struct FloorView {
  struct Node {
    Eigen::Matrix4f toEye;
    std::uint32_t mesh;
  };
  Eigen::Matrix4f projection;
  Eigen::Vector3f light;       ///< towards it, in the eye's coordinates, unit
  std::vector<Node> visible;   ///< sorted by mesh
  std::uint32_t prepared = 0;  ///< OpenGL's name of its instances, or its corners; 0: it has none
  std::uint32_t indices = 0;
  std::size_t triangles = 0;
};

class FloorDrawing {
public:
  FloorDrawing(const WallScene& scene, FloorWay way);

  /// Returns the eye's view of the scene at time t. Nodes are culled one by one by their bounding spheres.
  FloorView view(std::size_t wall, int eye, double t);
  void draw(const FloorView& view) const;
  void free(FloorView& view) const;

private:
  void prepareInstances(FloorView& view) const;
  void prepareMerged(FloorView& view) const;
  void drawEach(const FloorView& view) const;
  void drawInstances(const FloorView& view) const;
  void drawMerged(const FloorView& view) const;

  WallScene scene_;
  FloorWay way_;
  std::vector<WallNode> rest_;
  std::vector<WallMesh> meshes_;
  std::vector<double> radii_;
  std::uint32_t program_ = 0, corners_ = 0, indices_ = 0, layout_ = 0;
  int projection_ = 0, light_ = 0, toEye_ = 0;
};

}  // namespace stadion::bench
