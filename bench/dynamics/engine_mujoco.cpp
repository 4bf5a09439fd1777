/// MuJoCo (libmujoco-dev). Its contacts are soft and know no restitution, so it takes no part where things
/// bounce. One variant for each integrator.

#include "bench/dynamics/engine.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

namespace stadion::bench {
namespace {

const char* const kIntegrators[] = {"Euler", "RK4", "implicit"};

std::string words(V3 a) {
  return fmt::format("{} {} {}", a.x, a.y, a.z);
}

std::string formOf(const BodySpec& b) {
  if (b.form == Form::Sphere) return fmt::format("type='sphere' size='{}'", b.half.x);
  if (b.form == Form::Box) return fmt::format("type='box' size='{}'", words(b.half));
  return fmt::format("type='cylinder' zaxis='0 1 0' size='{} {}'", b.half.x, b.half.y);
}

std::string surfaceOf(double friction) {
  return fmt::format("friction='{} 0 0' condim='3'", friction);
}

class MujocoEngine final : public Engine {
public:
  explicit MujocoEngine(int integrator) : integrator_(integrator) {}

  ~MujocoEngine() override {
    if (data_) mj_deleteData(data_);
    if (model_) mj_deleteModel(model_);
  }

  void create(const WorldSpec& world) override {
    spec_ = world;
    mju_user_warning = [](const char*) {};  // or it writes a file where we stand
  }
  bool canBounce() const override { return false; }
  bool addMesh(const MeshSpec&) override { return false; }

  int addBody(const BodySpec& b) override {
    if (b.fixed) {
      fixed_ += fmt::format("<geom {} pos='{}' {}/>", formOf(b), words(b.p), surfaceOf(b.friction));
      return -1;
    }
    bodies_.push_back(b);
    return static_cast<int>(bodies_.size()) - 1;
  }

  void addGround(double, double friction) override {
    fixed_ += fmt::format("<geom type='plane' size='0 0 1' zaxis='0 1 0' {}/>", surfaceOf(friction));
  }

  State state(int i) override {
    build();
    const double *q = data_->qpos + 7 * i, *v = data_->qvel + 6 * i;
    const Q4 turn{q[3], q[4], q[5], q[6]};
    return {{q[0], q[1], q[2]}, {v[0], v[1], v[2]}, rotate(turn, {v[3], v[4], v[5]}), turn};
  }

  void force(int i, V3 newtons) override {
    build();
    double* f = data_->xfrc_applied + 6 * (i + 1);
    f[0] = newtons.x;
    f[1] = newtons.y;
    f[2] = newtons.z;
  }

  void step(double h) override {
    build();
    model_->opt.timestep = h;
    mj_step(model_, data_);
  }

private:
  std::string document() const {
    std::string text = fmt::format(
        "<mujoco><compiler inertiafromgeom='false'/><option cone='elliptic' impratio='10' integrator='{}' "
        "gravity='{}'/><size njmax='4000' nconmax='1000'/><worldbody>{}",
        kIntegrators[integrator_], words(spec_.gravity), fixed_);
    for (const BodySpec& b : bodies_)
      text += fmt::format("<body pos='{}'><freejoint/><inertial pos='0 0 0' mass='{}' diaginertia='{}'/>"
                          "<geom {} {}/></body>",
                          words(b.p), b.mass, words(b.inertia()), surfaceOf(b.friction), formOf(b));
    return text + "</worldbody></mujoco>";
  }

  /// The model is complete once it is first looked at.
  void build() {
    if (model_) return;
    const std::string text = document();
    const char* name = "model.xml";
    auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    const int at = mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(text.size()));
    char error[500] = "there is no room for the model";
    if (at >= 0) {
      std::memcpy(files->filedata[at], text.data(), text.size());
      model_ = mj_loadXML(name, files.get(), error, sizeof error);
    }
    mj_deleteVFS(files.get());
    if (!model_) {
      std::fprintf(stderr, "MuJoCo: %s\n", error);
      std::exit(3);
    }
    data_ = mj_makeData(model_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) start(bodies_[i], i);
  }

  void start(const BodySpec& b, std::size_t i) {
    double *v = data_->qvel + 6 * i, *q = data_->qpos + 7 * i + 3;
    const V3 omega = rotate(conj(b.q), b.omega);  // in the body's frame
    const double velocity[6] = {b.v.x, b.v.y, b.v.z, omega.x, omega.y, omega.z};
    const double turn[4] = {b.q.w, b.q.x, b.q.y, b.q.z};
    std::copy_n(velocity, 6, v);
    std::copy_n(turn, 4, q);
  }

  int integrator_;
  WorldSpec spec_;
  std::vector<BodySpec> bodies_;
  std::string fixed_;
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
};

}  // namespace

std::vector<std::string> engineVariants() {
  return {"mujoco-euler", "mujoco-rk4", "mujoco-implicit"};
}

std::unique_ptr<Engine> makeEngine(const std::string& variant) {
  return std::make_unique<MujocoEngine>(variant == "mujoco-rk4" ? 1 : variant == "mujoco-implicit" ? 2 : 0);
}

}  // namespace stadion::bench
