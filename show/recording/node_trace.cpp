#include "show/recording/node_trace.h"

#include "dynamics/nodes/dyn_object_node.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion {
namespace {

const char* nameOf(BodyMode mode) {
  switch (mode) {
  case BodyMode::Flight: return "flight";
  case BodyMode::Slide: return "slide";
  case BodyMode::Roll: return "roll";
  case BodyMode::Contact: return "contact";
  case BodyMode::Rest: return "rest";
  case BodyMode::Held: return "held";
  case BodyMode::Quarantined: return "quarantined";
  case BodyMode::Stuck: return "stuck";
  }
  return "?";
}

}  // namespace

NodeTrace::NodeTrace(std::string name)
    : name_(std::move(name)), table_("t,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,mode\n") {}

void NodeTrace::record(const TimeSignature& now, const Scene& scene) {
  const NodeRef node = scene.tree().resolve(name_, {1, 0});
  const LoadedScene* load = scene.tree().load(node.load);
  const auto* placed = load ? dynamic_cast<const PlacedNode*>(load->nodes[node.position].get()) : nullptr;
  if (!placed) return;  // it is unloaded at the moment
  const Pose X = poseOf(scene.placements().world(placed->placement()));
  table_ += fmt::format("{:.9f},{},{},{},{},{},{},{}", toSeconds(now.time), X.p.x(), X.p.y(), X.p.z(),
                        X.q.w(), X.q.x(), X.q.y(), X.q.z());
  if (const auto* body = dynamic_cast<const DynObjectNode*>(placed)) {
    const BodyState& s = body->state();
    table_ += fmt::format(",{},{},{},{},{},{},{}", s.v.x(), s.v.y(), s.v.z(), s.omega.x(), s.omega.y(),
                          s.omega.z(), nameOf(s.mode));
  } else {
    table_ += ",,,,,,,";
  }
  table_ += '\n';
}

std::string NodeTrace::fileName() const {
  std::string file = name_;
  std::replace(file.begin(), file.end(), '/', '_');
  return file;
}

}  // namespace stadion
