/// A pile of crates without a scene or a script: drops them one by one and says where each one comes to rest.

#include <stadion/dynamics/world/world.h>

#include <cstdio>
#include <vector>

using namespace stadion;

namespace {

constexpr Nanoseconds kFrame = 1'000'000'000 / 60;
constexpr double kSide = 0.5;  ///< [m]
constexpr double kMass = 20;   ///< [kg]
constexpr int kCrates = 10;

BodyId addCrate(World& world, ShapeId shape, FieldId gravity, int n) {
  BodyDef def;
  def.shape = shape;
  // Each one hangs 5 cm above the one below, a little aside.
  def.pose.p = {0.01 * (n % 2), 0, 0.5 * kSide + n * (kSide + 0.05)};
  def.mass.mass = kMass;
  def.mass.inertia = Vec3::Constant(kMass * kSide * kSide / 6);  // of a cube, about its centre
  def.surface.friction = 0.6;
  def.surface.restitution = 0.1;
  const BodyId id = world.addBody(def);
  world.hook(id, gravity, 0);
  return id;
}

}  // namespace

int main() {
  World world;
  ColliderDef ground;
  ground.shape = world.addShape(PlaneShape{});
  world.addCollider(ground);

  ForceField pull;
  pull.law = LinearField{{0, 0, -9.81}, LinearField::Unit::Acceleration};
  const FieldId gravity = world.addField(pull, true);

  BoxShape crate;
  crate.half = Vec3::Constant(0.5 * kSide);
  const ShapeId shape = world.addShape(crate);
  std::vector<BodyId> crates;
  for (int n = 0; n < kCrates; ++n) crates.push_back(addCrate(world, shape, gravity, n));

  std::uint64_t impacts = 0;
  Nanoseconds now = 0;
  for (int frame = 0; frame < 600; ++frame, now += kFrame) {
    world.advance(now, now + kFrame);
    for (const ContactEvent& event : world.events())
      if (event.kind == ContactEvent::Kind::Impact) ++impacts;
  }

  int resting = 0;
  for (const BodyId id : crates) {
    const BodyState s = world.state(id);
    resting += s.asleep();
    std::printf("crate %u: z %.6f m%s\n", id, s.p.z(), s.asleep() ? ", at rest" : "");
  }
  std::printf("%d of %d crates rest after %.3f s; %llu impacts\n", resting, kCrates, toSeconds(now),
              static_cast<unsigned long long>(impacts));
  return resting == kCrates ? 0 : 1;
}
