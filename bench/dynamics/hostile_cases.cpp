/// C13: degenerate meshes, places far out, absurd speeds, not a number, bodies in one place, mass ratio 1e6.

#include "bench/dynamics/cases.h"

#include <algorithm>
#include <limits>

namespace stadion::bench {
namespace {

/// A floor with collapsed, doubled, unconnected and stretched-out triangles among the good ones.
MeshSpec spoiltFloor() {
  MeshSpec m = gridMesh(-5, 5, -5, 5, 10, 10, 0, 0.5);
  const auto good = m.triangles;
  for (std::size_t i = 0; i < good.size(); ++i) {
    const auto& t = good[i];
    if (i % 5 == 0) m.triangles.push_back({t[0], t[0], t[1]});
    if (i % 7 == 0) m.triangles.push_back(t);
    if (i % 11 == 0) {
      m.points.push_back(V3(m.points[static_cast<std::size_t>(t[0])]));
      m.triangles.push_back({static_cast<int>(m.points.size()) - 1, t[1], t[2]});
    }
  }
  for (const double x : {0., 1., 2.}) m.points.push_back({x, 0, 0});
  const int end = static_cast<int>(m.points.size());
  m.triangles.push_back({end - 3, end - 2, end - 1});
  return m;
}

void degenerateMesh(Outcome& out) {
  Scene s(out);
  if (!s.engine().addMesh(spoiltFloor())) {
    out.m["mesh_refused"] = 1;
    return;
  }
  for (int i = 0; i < 25; ++i) {
    BodySpec b;
    b.form = i % 2 ? Form::Box : Form::Sphere;
    b.friction = 0.5;
    b.p = {-4 + 2.0 * (i % 5), 0.5, -4 + 2.0 * (i / 5)};
    s.add(b);
  }
  for (int i = 0; i < 300; ++i) s.frame();
  double worst = 0;
  int bad = 0;
  for (int i = 0; i < 25; ++i) {
    const double y = s.state(i).p.y - 0.1;
    if (!(std::fabs(y) < 0.03)) ++bad;
    if (std::isfinite(y)) worst = std::max(worst, std::fabs(y));
  }
  out.m["bad_of_25"] = bad;
  out.m["err"] = worst;
}

void farOut(Outcome& out) {
  const double far = 1e5;
  Scene s(out);
  BodySpec b;
  b.half = {0.11, 0.11, 0.11};
  b.p = {far, 1.5, 0};
  b.v = {20, 15, 3};
  s.add(b);
  double worst = 0;
  for (int i = 1; i <= 150; ++i) {
    s.frame();
    const double t = i * kFrame;
    const V3 exact{far + 20 * t, 1.5 + 15 * t - kG / 2 * t * t, 3 * t};
    worst = std::max(worst, norm(s.state().p - exact));
  }
  out.m["err"] = worst;
}

void hugeSpeed(Outcome& out) {
  Scene s(out, {0, 0, 0});
  BodySpec b;
  b.v = {1e6, 0, 0};
  s.add(b);
  b.p = {0, 5, 0};
  b.v = {0, 0, 1e6};
  b.continuous = true;
  s.add(b);
  for (int i = 0; i < 60; ++i) s.frame();
  out.m["relerr"] = s.state(0).p.x / 1e6 - 1;
  out.m["relerr_ccd"] = s.state(1).p.z / 1e6 - 1;
  out.m["err"] = std::fabs(out.m["relerr"]);
}

void hugeHit(Outcome& out) {
  Scene s(out, {0, 0, 0});
  s.engine().addGround(0.5, 0);
  BodySpec b;
  b.restitution = 0.5;
  b.continuous = true;
  b.p = {0, 3, 0};
  b.v = {0, -1e5, 0};
  s.add(b);
  for (int i = 0; i < 6; ++i) s.frame();
  const State st = s.state();
  out.m["y"] = st.p.y;
  out.m["vy"] = st.v.y;
  out.m["tunnelled"] = !(st.p.y > -1);
  out.m["err"] = out.m["tunnelled"];
}

void notANumber(Outcome& out) {
  Scene s(out);
  s.engine().addGround(0, 0.5);
  BodySpec b;
  b.friction = 0.5;
  b.p = {0, 0.1, 0};
  s.add(b);
  b.p = {50, 3, 0};
  s.add(b);
  s.engine().force(1, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  for (int i = 0; i < 60; ++i) s.frame();
  out.m["neighbour_ok"] = std::fabs(s.state(0).p.y - 0.1) < 0.05;
  out.m["err"] = out.m["neighbour_ok"] == 0;
}

void coincident(Outcome& out) {
  Scene s(out);
  s.engine().addGround(0, 0.5);
  BodySpec b;
  b.friction = 0.5;
  b.p = {0, 1, 0};
  s.add(b);
  s.add(b);
  b.form = Form::Box;
  b.p = {3, 1, 0};
  s.add(b);
  s.add(b);
  double fastest = 0;
  bool finite = true;
  for (int i = 0; i < 120; ++i) {
    s.frame();
    for (int j = 0; j < 4; ++j) {
      const double v = norm(s.state(j).v);
      if (std::isfinite(v))
        fastest = std::max(fastest, v);
      else
        finite = false;
    }
  }
  out.m["max_speed"] = fastest;
  out.m["nonfinite"] = !finite;
  out.m["err"] = fastest;
}

void massRatio(Outcome& out) {
  Scene s(out);
  s.engine().addGround(0, 0.5);
  BodySpec b;
  b.form = Form::Box;
  b.friction = 0.5;
  b.mass = 1e-3;
  b.p = {0, 0.1, 0};
  s.add(b);
  b.mass = 1e3;
  b.p = {0, 0.3, 0};
  s.add(b);
  for (int i = 0; i < 300; ++i) s.frame();
  out.m["top_sink"] = 0.3 - s.state(1).p.y;
  out.m["err"] = std::fabs(out.m["top_sink"]);
}

}  // namespace

void addHostileCases(CaseList& list) {
  list.push_back({"C13_degmesh", degenerateMesh, oneStep(), 1});
  list.push_back({"C13_far", farOut, oneStep(), 1});
  list.push_back({"C13_huge", hugeSpeed, oneStep(), 1});
  list.push_back({"C13_hugehit", hugeHit, oneStep(), 1});
  list.push_back({"C13_nan", notANumber, oneStep(), 1});
  list.push_back({"C13_coincident", coincident, oneStep(), 1});
  list.push_back({"C13_massratio", massRatio, oneStep(), 1});
}

}  // namespace stadion::bench
