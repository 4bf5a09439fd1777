/// C09: small fast balls and a spinning disc against a wall of 1 mm (or a sheet of two triangles) at x = 0,
/// each at eight places between two frames.

#include "bench/dynamics/cases.h"
#include "bench/dynamics/reference_solutions.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

struct Shot {
  bool disc = false;
  double speed = 5;         ///< [m/s]
  bool continuous = false;  ///< with the engine's continuous collision detection
  bool mesh = false;
  V3 omega;
};

constexpr double kRestitution = 0.5;
constexpr int kPhases = 8;

/// False if the engine has no meshes.
bool addWall(Scene& s, bool mesh) {
  if (mesh) {
    MeshSpec m;
    m.restitution = kRestitution;
    m.points = {{0, -10, -10}, {0, 10, -10}, {0, 10, 30}, {0, -10, 30}};
    m.triangles = {{0, 2, 1}, {0, 3, 2}};
    return s.engine().addMesh(m);
  }
  BodySpec wall;
  wall.form = Form::Box;
  wall.half = {0.0005, 10, 20};
  wall.p = {0, 0, 10};
  wall.fixed = true;
  wall.restitution = kRestitution;
  s.add(wall);
  return true;
}

BodySpec bullet(const Shot& shot, int phase) {
  BodySpec b;
  b.restitution = kRestitution;
  b.continuous = shot.continuous;
  b.p = {-1 - shot.speed / 60 * phase / kPhases, 0.3, 2.0 * phase};
  b.v = {shot.speed, 0, 0};
  b.omega = shot.omega;
  if (shot.disc) {
    b.form = Form::Cylinder;
    b.half = {0.11, 0.012, 0.11};
    b.mass = 2;
  } else {
    b.half = {0.02, 0.02, 0.02};
    b.mass = 0.05;
  }
  return b;
}

/// Where the disc's centre is at the end: exactly, hit by hit.
double discAtEnd(const Shot& shot, const BodySpec& b, double wall, double seconds) {
  if (shot.omega.z != 0) {
    const TumblingDisc disc{b.half.x, b.half.y, b.mass, b.inertia().z, kRestitution, wall};
    return tumbleAgainstWall(disc, {b.p.x, b.v.x, 0, shot.omega.z}, seconds).x;
  }
  const double hit = (wall - b.half.x - b.p.x) / b.v.x;  // the rim comes first, the disc turns in itself
  return wall - b.half.x - kRestitution * b.v.x * (seconds - hit);
}

void shoot(Outcome& out, const Shot& shot) {
  Scene s(out, {0, 0, 0});
  if (s.lacks(s.engine().canBounce()) || s.lacks(addWall(s, shot.mesh))) return;
  std::vector<double> from;
  for (int j = 0; j < kPhases; ++j) {
    const BodySpec b = bullet(shot, j);
    from.push_back(b.p.x);
    s.add(b);
  }
  if (out.unsupported) return;
  const double v = shot.speed, radius = 0.02, front = shot.mesh ? 0 : 0.0005;
  const int frames = static_cast<int>(std::ceil((1.0 + v / 60) / v * 60)) + 6;
  for (int i = 0; i < frames; ++i) s.frame();
  int tunnelled = 0, stuck = 0;
  double place = 0, speed = 0;
  for (int j = 0; j < kPhases; ++j) {
    const State st = s.state(j);
    if (st.p.x > 0) {
      ++tunnelled;
      continue;
    }
    if (st.v.x > -0.05 * v) ++stuck;
    if (shot.disc) {
      place = std::max(place, std::fabs(st.p.x - discAtEnd(shot, bullet(shot, j), -front, frames * kFrame)));
      continue;
    }
    const double hit = (-radius - front - from[static_cast<std::size_t>(j)]) / v;
    const double x = -radius - front - kRestitution * v * (frames * kFrame - hit);
    place = std::max(place, std::fabs(st.p.x - x));
    speed = std::max(speed, std::fabs(st.v.x + kRestitution * v) / v);
  }
  out.m["tunnelled_of_8"] = tunnelled;
  out.m["no_rebound_of_8"] = stuck;
  if (shot.disc) {
    out.m["err"] = tunnelled ? 99 : place;
    out.m["pos_err"] = place;
  } else {
    out.m["err"] = tunnelled ? 99 : place;
    out.m["vel_relerr"] = speed;
  }
}

void addShot(CaseList& list, const std::string& name, const Shot& shot, const std::vector<int>& steps) {
  list.push_back({name, [shot](Outcome& o) { shoot(o, shot); }, steps, 3});
}

}  // namespace

void addThinWallCases(CaseList& list) {
  static const std::vector<int> two{1, 4};
  for (const double v : {5., 10., 20., 50., 100., 200., 500., 1000.})
    for (const bool ccd : {false, true})
      addShot(list, fmt::format("C09_tunnel_v{:g}_{}", v, ccd ? "ccd" : "noccd"), {false, v, ccd, false, {}},
              ccd ? two : oneStep());
  addShot(list, "C09_tunnel_mesh_v50_ccd", {false, 50, true, true, {}}, oneStep());
  addShot(list, "C09_disc_flat_ccd", {true, 30, true, false, {0, 40, 0}}, oneStep());
  addShot(list, "C09_disc_tumble_ccd", {true, 30, true, false, {0, 0, 40}}, oneStep());
}

}  // namespace stadion::bench
