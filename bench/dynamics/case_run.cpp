#include "bench/dynamics/case_run.h"

#include <algorithm>
#include <array>
#include <ctime>

namespace stadion::bench {
namespace {

double processorSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// What two readings with nothing between them are apart: the clock is a call into the kernel, as expensive
/// as the frame of a few bodies.
double readingSeconds() {
  std::array<double, 101> apart{};
  for (double& x : apart) {
    const double start = processorSeconds();
    x = processorSeconds() - start;
  }
  std::sort(apart.begin(), apart.end());
  return apart[apart.size() / 2];
}

}  // namespace

V3 BodySpec::inertia() const {
  const double a = half.x, b = half.y, c = half.z;
  if (form == Form::Sphere) {
    const double i = 0.4 * mass * a * a;
    return {i, i, i};
  }
  if (form == Form::Cylinder) {
    const double t = mass * (3 * a * a + 4 * b * b) / 12;
    return {t, 0.5 * mass * a * a, t};
  }
  return {mass / 3 * (b * b + c * c), mass / 3 * (a * a + c * c), mass / 3 * (a * a + b * b)};
}

Scene::Scene(Outcome& outcome, V3 gravity, int maxBodies)
    : outcome_(outcome), engine_(makeEngine(outcome.variant)), reading_(readingSeconds()) {
  WorldSpec world;
  world.gravity = gravity;
  world.maxBodies = maxBodies;
  engine_->create(world);
}

int Scene::add(const BodySpec& body) {
  if (!engine_->has(body.form)) outcome_.unsupported = true;
  const int id = engine_->addBody(body);
  if (!body.fixed) ++bodies_;
  return id;
}

void Scene::drag(int body, double k, double mass) {
  if (engine_->quadraticDrag(body, k)) return;
  dragged_.push_back({body, k, mass});
  forces_ = [this] {
    for (const Dragged& d : dragged_) {
      const V3 v = engine_->state(d.body).v;
      engine_->force(d.body, (-d.mass * d.k * norm(v)) * v);
    }
  };
}

void Scene::frame(double dt) {
  if (!started_) {
    started_ = true;
    if (bodies_) engine_->state(0);  // engines that build their model late do so now
  }
  const double start = processorSeconds();
  engine_->frame(dt, outcome_.n, forces_);
  const double cost = std::max(0.0, processorSeconds() - start - reading_);
  outcome_.cpu += cost;
  outcome_.worst = std::max(outcome_.worst, cost);
  outcome_.bodyFrames += bodies_;
}

bool Scene::lacks(bool supported) {
  if (!supported) outcome_.unsupported = true;
  return !supported;
}

int framesIn(double seconds) {
  return static_cast<int>(std::lround(seconds / kFrame));
}

MeshSpec gridMesh(double x0, double x1, double z0, double z1, int nx, int nz, double restitution,
                  double friction) {
  MeshSpec m;
  m.restitution = restitution;
  m.friction = friction;
  for (int j = 0; j <= nz; ++j)
    for (int i = 0; i <= nx; ++i) m.points.push_back({x0 + (x1 - x0) * i / nx, 0, z0 + (z1 - z0) * j / nz});
  const auto id = [nx](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j < nz; ++j)
    for (int i = 0; i < nx; ++i) {
      m.triangles.push_back({id(i, j), id(i, j + 1), id(i + 1, j)});
      m.triangles.push_back({id(i + 1, j), id(i, j + 1), id(i + 1, j + 1)});
    }
  return m;
}

}  // namespace stadion::bench
