#pragma once
/// What App publishes for the later stages: plain records of fixed width, and the set of those that changed.
///
/// The records contain no pointers, so other processes can map them.
///
/// Frames   World, in double precision.
/// Threads  App fills a ChangeSet; the later stages read copies of its records.
/// Errors   none.

#include "engine/asset/mesh_store.h"
#include "engine/base/time_signature.h"
#include "engine/core/message.h"
#include "engine/figure/figure_record.h"
#include "engine/maths/maths.h"
#include "engine/published/paint.h"
#include "engine/published/shadow_places.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace stadion {

using InstanceId = std::uint32_t;
using ChunkId = std::uint32_t;
constexpr ChunkId kNoChunk = 0;

constexpr std::size_t kMostLights = 16;  ///< limit of the lights that shine at a time; the scene chooses them
constexpr std::size_t kMostChunks = 4096;  ///< shown at a time; objects of further files are instances

/// An instance: a mesh to draw.
struct InstanceRecord {
  double model[12];  ///< X_WN (3 x 4), row major; a copy, since Cull reads it while App moves the node
  double centre[3];  ///< centre of the bounding sphere in World [m]
  float radius;      ///< [m]; < 0 = not there
  MeshId mesh;
  std::uint32_t flags;
  NodeRef owner;    ///< for profiling
  float lodFactor;  ///< factor of the distance for levels of detail; 0 = the mesh has no simplified levels

  static constexpr std::uint32_t kShown = 1, kTransparent = 2;
  static constexpr unsigned kFigureAt = 8;  ///< the bits of a figure's number, which is not 0, begin here

  static constexpr unsigned kPaintAt = 20;  ///< likewise, of a paint's number; the last bit is free

  std::uint32_t figure() const { return flags >> kFigureAt & kMostFigures; }
  std::uint32_t paint() const { return flags >> kPaintAt & kMostPaints; }
};
static_assert(std::is_trivially_copyable_v<InstanceRecord> && sizeof(InstanceRecord) == 144);
static_assert((kMostFigures << InstanceRecord::kFigureAt) < (1U << InstanceRecord::kPaintAt) &&
              (kMostPaints << InstanceRecord::kPaintAt) < (1U << 31));

InstanceRecord makeInstance(const Affine& X_WN, const Mesh& mesh, MeshId id, bool shown, NodeRef owner,
                            double lodFactor = 1);

/// Where the instance is: its matrix, and the sphere around it. Leaves the rest of the record as it is.
/// Both forms compute the same bits, so it does not matter which of them published an instance.
void placeInstance(InstanceRecord& record, const Affine& X_WN, const Sphere& sphere_N);
/// Places an instance by the rows of a matrix whose sphereScale() is known.
inline void placeInstance(InstanceRecord& r, const std::array<double, 12>& m, double scale,
                          const Sphere& sphere_N) {
  std::memcpy(r.model, m.data(), sizeof r.model);
  const double x = sphere_N.centre.x(), y = sphere_N.centre.y(), z = sphere_N.centre.z();
  for (std::size_t row = 0; row < 3; ++row)
    r.centre[row] = m[4 * row] * x + m[4 * row + 1] * y + (m[4 * row + 2] * z + m[4 * row + 3]);
  // Rounding to float must not shrink the sphere.
  r.radius = static_cast<float>(sphere_N.radius * scale * (1 + 1e-6));
}
/// The factor by which a sphere in N grows in World.
double sphereScale(const Affine& X_WN);

struct LightRecord {
  std::uint32_t kind = 0;                       ///< DrawLight::Kind
  float colour[3] = {1, 1, 1};                  ///< linear, intensity included
  double position[3] = {0, 0, 0};               ///< World [m]
  double direction[3] = {0, 0, -1};             ///< World, unit, the way the light goes
  float range = 0, cosInner = 1, cosOuter = 0;  ///< range [m]; directional: greater than 0 = casts shadows
  bool fallsOff = false;  ///< point, spot: with the square of the distance, beside its range
  NodeRef owner;          ///< the light node; invalid: the sun of shows without lights
};

/// Light from all around, in place of a sky's `ambient`.
struct EnvironmentRecord {
  std::uint32_t lit = 0;         ///< 0: there is none, and the sky's `ambient` lights
  MeshId picture = kNoMesh;      ///< whose Mesh::environment it is; none: the light of the sky's own colours
  std::uint32_t background = 0;  ///< 1: the picture is seen behind everything
  float intensity = 1;
  float turnCos = 1, turnSin = 0;  ///< it is turned about Z, counter-clockwise seen from above
};

/// How light becomes a picture's colours.
enum class ToneCurve : std::uint32_t {
  Soft,     ///< up to 0.8 as it is, above bent towards 1
  Clamp,    ///< cut at 1
  Neutral,  ///< Khronos PBR Neutral
  Aces,     ///< the film curve of ACES, as fitted by Narkowicz
};

struct TonesRecord {
  float exposure = 1;  ///< what light is multiplied with before the curve
  ToneCurve curve = ToneCurve::Soft;
};

struct SkyRecord {
  float zenith[3] = {0.18f, 0.36f, 0.72f}, horizon[3] = {0.66f, 0.76f, 0.85f},
        ground[3] = {0.28f, 0.26f, 0.22f}, ambient[3] = {0.25f, 0.27f, 0.30f};
  float haze = 0;  ///< [m], 0 = none
  EnvironmentRecord environment;
  TonesRecord tones;
};

/// Where the visitor is.
struct ViewerRecord {
  double rigPosition[3] = {0, 0, 0}, rigOrientation[4] = {0, 0, 0, 1};      ///< X_WR, quaternion x y z w
  double headPosition[3] = {0, 0, 1.7}, headOrientation[4] = {0, 0, 0, 1};  ///< X_RH
  Nanoseconds poseTime = 0;  ///< show time the head pose is for
  double stress = 1;         ///< everything counts as so many times farther away, when levels are chosen

  Pose rig() const { return {Vec3(rigPosition), Quat(rigOrientation)}; }
  Pose head() const { return {Vec3(headPosition), Quat(headOrientation)}; }
  Vec3 headInWorld() const { return rig() * head().p; }  ///< [m]
  void set(const Pose& X_WR, const Pose& X_RH);
};

/// The changes of a frame.
struct ChangeSet {
  struct Instance {
    InstanceId id;
    InstanceRecord record;
    Instance() {}  // the publisher fills it in
    Instance(InstanceId i, const InstanceRecord& r) : id(i), record(r) {}
  };
  struct Chunk {
    ChunkId id;
    bool shown;
  };
  struct StaticItem {  ///< an object of a chunk that has left it, because it moves now
    ChunkId chunk;
    std::uint32_t index;
    bool hidden;
  };

  /// Takes changed instances a block at a time, while they are in the processor's cache.
  class Sink {
  public:
    virtual ~Sink() = default;
    virtual void take(std::span<const Instance> block) = 0;
  };
  static constexpr std::size_t kBlock = 64;

  TimeSignature signature;
  Sink* sink = nullptr;             ///< where instances go; null: they stay here
  std::vector<Instance> instances;  ///< instances that the sink has not taken
  std::vector<Chunk> chunks;
  std::vector<StaticItem> statics;
  bool lightsChanged = false;
  std::vector<LightRecord> lights;  ///< all that shine (at most kMostLights), when lightsChanged
  bool figuresChanged = false;
  std::vector<FigureRecord> figures;  ///< what each plays, by number - 1, when figuresChanged
  bool paintsChanged = false;
  std::vector<PaintRecord> paints;  ///< by number - 1, when paintsChanged
  SkyRecord sky;
  ViewerRecord viewer;
  ShadowRecord shadows;

  void clear();  ///< all but the sink
};

}  // namespace stadion
