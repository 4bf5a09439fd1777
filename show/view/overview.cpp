#include "show/view/overview.h"

#include "engine/asset/mesh_checks.h"
#include "engine/input/tracker_names.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

constexpr double kHalfAngle = 0.42;  ///< of the picture's height [rad]
constexpr double kSteepest = 1.45;   ///< [rad]

using Colour = std::array<float, 3>;
constexpr Colour kFrame{0.05f, 0.75f, 0.85f}, kFigure{0.95f, 0.45f, 0.1f}, kStick{0.95f, 0.9f, 0.2f};

Aabb roomOf(const WallFile& walls) {
  Aabb room;
  for (const WallEntry& e : walls.walls)
    for (const Vec3& p : {e.wall.lowerLeft, e.wall.lowerRight, e.wall.upperLeft, e.wall.upperRight()})
      room.include(p);
  room.include(Vec3::Zero());
  return room;
}

double usualDistance(const WallFile& walls) {
  const Aabb room = roomOf(walls);
  return 1.35 * (room.hi - room.lo).norm();
}

/// Boxes along lines, of one colour that shines by itself, so that it is seen in a dark show too.
class Figure {
public:
  explicit Figure(const Colour& colour) {
    Material material;
    material.baseColour = {colour[0], colour[1], colour[2], 1};
    material.emissive = {0.35f * colour[0], 0.35f * colour[1], 0.35f * colour[2]};
    mesh_->materials = {material};
  }

  /// A beam of square section from a to b, `wide` and `thick` across.
  void beam(const Vec3& a, const Vec3& b, double wide, double thick) {
    const Vec3 along = (b - a).normalized();
    const Vec3 across =
        (std::fabs(along.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitY()).cross(along).normalized();
    const Vec3 centre = 0.5 * (a + b), u = 0.5 * (b - a), v = 0.5 * wide * across,
               w = 0.5 * thick * along.cross(across);
    side(centre + u, u, v, w);
    side(centre - u, u, w, v);
    side(centre + v, v, w, u);
    side(centre - v, v, u, w);
    side(centre + w, w, u, v);
    side(centre - w, w, v, u);
  }

  std::unique_ptr<const Mesh> take(const char* name) {
    mesh_->submeshes = {{0, static_cast<std::uint32_t>(mesh_->indices.size()), 0}};
    mesh_->materials[0].doubleSided = true;
    mesh_->name = name;
    finish(*mesh_);
    return std::move(mesh_);
  }

private:
  static std::array<float, 3> plain(const Vec3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }
  void side(const Vec3& middle, const Vec3& out, const Vec3& u, const Vec3& v) {
    const Vec3 n = out.normalized();
    const Vec3 normal = u.cross(v).dot(n) > 0 ? n : Vec3(-n);
    const auto first = static_cast<std::uint32_t>(mesh_->positions.size());
    for (const Vec3& p :
         {Vec3(middle - u - v), Vec3(middle + u - v), Vec3(middle + u + v), Vec3(middle - u + v)}) {
      mesh_->positions.push_back(plain(p));
      mesh_->normals.push_back(plain(normal));
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh_->indices.push_back(first + i);
  }

  std::unique_ptr<Mesh> mesh_ = std::make_unique<Mesh>();
};

std::unique_ptr<const Mesh> roomMesh(const WallFile& walls) {
  Figure figure(kFrame);
  for (const WallEntry& e : walls.walls) {
    const std::array<Vec3, 4> c{e.wall.lowerLeft, e.wall.lowerRight, e.wall.upperRight(), e.wall.upperLeft};
    const double thick = 0.012 * std::max(basis(e.wall).width, basis(e.wall).height);
    for (std::size_t i = 0; i < 4; ++i) figure.beam(c[i], c[(i + 1) % 4], thick, thick);
  }
  return figure.take("the room's walls");
}

/// Looking along +Y; the origin is between the eyes.
std::unique_ptr<const Mesh> headMesh() {
  Figure figure(kFigure);
  figure.beam({0, -0.02, -0.12}, {0, -0.02, 0.12}, 0.17, 0.2);  // head
  figure.beam({0, 0.05, -0.02}, {0, 0.14, -0.02}, 0.04, 0.05);  // nose
  return figure.take("the visitor's head");
}

/// From the eyes down, turned as the head is, and upright.
std::unique_ptr<const Mesh> bodyMesh() {
  Figure figure(kFigure);
  figure.beam({0, -0.06, -0.85}, {0, -0.06, -0.2}, 0.42, 0.22);  // trunk
  figure.beam({-0.11, -0.06, -1.65}, {-0.11, -0.06, -0.85}, 0.14, 0.16);
  figure.beam({0.11, -0.06, -1.65}, {0.11, -0.06, -0.85}, 0.14, 0.16);
  return figure.take("the visitor's body");
}

std::unique_ptr<const Mesh> wandMesh() {
  Figure figure(kStick);
  figure.beam({0, -0.08, 0}, {0, 0.3, 0}, 0.04, 0.04);
  figure.beam({-0.06, 0.2, 0}, {0.06, 0.2, 0}, 0.03, 0.03);
  return figure.take("the wand");
}

/// The pose without its tilt.
Pose upright(const Pose& X) {
  const Vec3 ahead = X.q * Vec3::UnitY();
  const double turn = ahead.head<2>().norm() > 1e-6 ? det::atan2(-ahead.x(), ahead.y()) : 0;
  return {X.p, det::expRotation(Vec3(0, 0, turn))};
}

}  // namespace

void OverviewPlace::turn(double right, double up) {
  around = std::remainder(around + right, 2 * kPi);
  above = std::clamp(above + up, -0.2, kSteepest);
}

void OverviewPlace::zoom(double factor, const WallFile& walls) {
  const double usual = usualDistance(walls);
  distance = std::clamp((distance > 0 ? distance : usual) * factor, 0.2 * usual, 20 * usual);
}

Overview::Overview(MeshStore& meshes, const WallFile& walls, double aspect)
    : meshes_(meshes), walls_(walls), aspect_(aspect), room_(meshes.add(roomMesh(walls))),
      head_(meshes.add(headMesh())), body_(meshes.add(bodyMesh())), wand_(meshes.add(wandMesh())) {}

Overview::~Overview() {
  for (const MeshId mesh : {room_, head_, body_, wand_}) meshes_.release(mesh, 0);
}

void Overview::move(const OverviewPlace& place) {
  const std::lock_guard lock(mutex_);
  place_ = place;
}

void Overview::see(const InputSample& input) {
  const TrackerSample* wand = input.find(kWandTracker);
  const std::lock_guard lock(mutex_);
  X_RT_.reset();
  if (wand && wand->valid) X_RT_ = wand->X_RT;
}

std::optional<CameraView> Overview::view() const {
  OverviewPlace place;
  {
    const std::lock_guard lock(mutex_);
    place = place_;
  }
  if (!place.shown) return std::nullopt;
  const Aabb room = roomOf(walls_);
  const double far = place.distance > 0 ? place.distance : usualDistance(walls_);
  const det::SinCos around = det::sincos(place.around), above = det::sincos(place.above);
  const Vec3 back(around.sin * above.cos, -around.cos * above.cos, above.sin);
  CameraView from;
  from.eye = room.centre() + far * back;
  const Vec3 right(around.cos, around.sin, 0), up = back.cross(right);
  const double high = det::tan(kHalfAngle), wide = aspect_ * high;
  const Vec3 centre = from.eye - back;
  from.screen = {"overview", centre - wide * right - high * up, centre + wide * right - high * up,
                 centre - wide * right + high * up};
  return from;
}

void Overview::addTo(std::vector<InstanceRecord>& records, const ViewerRecord& viewer) const {
  const auto add = [&](MeshId mesh, const Pose& X_WN) {
    records.push_back(makeInstance(toAffine(X_WN), *meshes_.find(mesh), mesh, true, NodeRef{}));
  };
  add(room_, viewer.rig());
  add(head_, viewer.rig() * viewer.head());
  add(body_, viewer.rig() * upright(viewer.head()));
  const std::lock_guard lock(mutex_);
  if (X_RT_) add(wand_, viewer.rig() * *X_RT_);
}

}  // namespace stadion
