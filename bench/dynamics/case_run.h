#pragma once
/// One case under way: a world of one engine, its clock and its cost; and what a case leaves behind.

#include "bench/dynamics/engine.h"

#include <map>

namespace stadion::bench {

constexpr double kG = 9.81;          ///< [m/s2]
constexpr double kFrame = 1.0 / 60;  ///< [s]
constexpr int kCopies = 16;          ///< identical bodies share the fixed costs; copy 0 is the one judged

struct Outcome {
  std::string variant;  ///< variant of the engine
  int n = 1;            ///< steps a frame
  std::map<std::string, double> m;
  double cpu = 0, worst = 0;  ///< [s] of processor time, in all and in the most expensive frame
  long bodyFrames = 0;
  bool unsupported = false;

  double nsPerBodyFrame() const { return bodyFrames ? cpu / static_cast<double>(bodyFrames) * 1e9 : 0; }
};

class Scene {
public:
  explicit Scene(Outcome& outcome, V3 gravity = {0, -kG, 0}, int maxBodies = 64);

  int add(const BodySpec& body);
  void drag(int body, double k, double mass);
  /// Advances one frame; only this is timed, and what reading the clock costs is taken off.
  void frame(double dt = kFrame);

  Engine& engine() { return *engine_; }
  State state(int body = 0) { return engine_->state(body); }
  /// Gives up if the engine has no such thing.
  bool lacks(bool supported);

private:
  struct Dragged {
    int body;
    double k, mass;
  };
  Outcome& outcome_;
  std::unique_ptr<Engine> engine_;
  double reading_;  ///< cost of reading the clock [s]
  int bodies_ = 0;
  bool started_ = false;
  std::vector<Dragged> dragged_;
  std::function<void()> forces_;
};

/// Frames in `seconds`.
int framesIn(double seconds);
/// A flat mesh at y = 0 facing up.
MeshSpec gridMesh(double x0, double x1, double z0, double z1, int nx, int nz, double restitution,
                  double friction);

}  // namespace stadion::bench
