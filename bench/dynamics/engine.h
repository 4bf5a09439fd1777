#pragma once
/// What the test cases ask of a physics engine. One adapter (engine_*.cpp) for each; the cases know no
/// engine.
///
/// Frames   right-handed, y up; quaternions body to world; angular velocity in the world's frame.
/// Units    SI.
/// Threads  one.
/// It knows nothing of engine/ and dynamics/ on purpose: what is measured must not measure itself.

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stadion::bench {

struct V3 {
  double x = 0, y = 0, z = 0;
};

inline V3 operator+(V3 a, V3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline V3 operator-(V3 a, V3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline V3 operator*(double s, V3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(V3 a, V3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline V3 cross(V3 a, V3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(V3 a) {
  return std::sqrt(dot(a, a));
}

struct Q4 {
  double w = 1, x = 0, y = 0, z = 0;
};

inline Q4 operator*(Q4 a, Q4 b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
inline Q4 conj(Q4 q) {
  return {q.w, -q.x, -q.y, -q.z};
}
inline V3 rotate(Q4 q, V3 v) {
  const V3 u{q.x, q.y, q.z};
  const V3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}
/// Between two orientations [rad].
inline double angleBetween(Q4 a, Q4 b) {
  const Q4 d = conj(a) * b;
  return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::fabs(d.w));
}

enum class Form { Sphere, Box, Cylinder };  ///< a cylinder's axis is y

struct WorldSpec {
  V3 gravity{0, -9.81, 0};
  int maxBodies = 64;
};

struct BodySpec {
  Form form = Form::Sphere;
  V3 half{0.1, 0.1, 0.1};  ///< sphere: x is the radius; cylinder: x radius, y half the height
  double mass = 1;
  V3 p, v, omega;
  Q4 q;
  double restitution = 0, friction = 0;
  bool continuous = false;  ///< ask the engine for its continuous collision detection
  bool fixed = false;

  V3 inertia() const;  ///< principal, of the solid form
};

struct MeshSpec {
  std::vector<V3> points;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  double restitution = 0, friction = 0;
};

struct State {
  V3 p, v, omega;
  Q4 q;
};

class Engine {
public:
  virtual ~Engine() = default;
  virtual void create(const WorldSpec& world) = 0;
  virtual int addBody(const BodySpec& body) = 0;                    ///< -1 for a fixed one
  virtual void addGround(double restitution, double friction) = 0;  ///< the plane y = 0
  virtual bool addMesh(const MeshSpec& mesh) = 0;                   ///< fixed; false: there are none
  virtual State state(int body) = 0;
  virtual void force(int body, V3 newtons) = 0;  ///< at the centre, for the coming step
  /// The engine itself does a = -k |v| v; false: it cannot, and the case exerts the force.
  virtual bool quadraticDrag(int /*body*/, double /*k*/) { return false; }
  virtual bool canBounce() const { return true; }
  virtual bool has(Form) const { return true; }
  virtual void step(double h) = 0;

  /// Computes a displayed frame in n steps. `before` each step, the case applies its own forces.
  virtual void frame(double dt, int n, const std::function<void()>& before) {
    for (int i = 0; i < n; ++i) {
      if (before) before();
      step(dt / n);
    }
  }
};

/// Returns the variants of this program's engine; their names begin with the engine's name.
std::vector<std::string> engineVariants();
std::unique_ptr<Engine> makeEngine(const std::string& variant);

}  // namespace stadion::bench
