#include "engine/input/scripted_input.h"
#include "pipeline/cluster/cluster_leader.h"
#include "pipeline/cluster/follower.h"
#include "tests/fuzz/packets.h"

#include <cmath>
#include <utility>

namespace stadion::fuzz {
namespace {

using namespace cluster;

ClusterFile room() {
  ClusterFile file;
  for (const char* name : {"front", "left", "right"}) file.nodes.push_back({name, {name}, 1});
  return file;
}

/// A leader and a follower without a network between them; neither waits.
class Room {
public:
  void take(Step step, Bytes bytes) {
    const std::uint8_t figure = bytes.empty() ? 0 : bytes[0];
    switch (step) {
    case Step::Session: return receive<Session>(stadion_wire_Session_desc, bytes);
    case Step::Presence: return receive<Presence>(stadion_wire_Presence_desc, bytes);
    case Step::Order: return receive<Order>(stadion_wire_Order_desc, bytes);
    case Step::Drawn: return receive<Drawn>(stadion_wire_Drawn_desc, bytes);
    case Step::Go: return receive<Go>(stadion_wire_Go_desc, bytes);
    case Step::SceneHash: return receive<SceneHash>(stadion_wire_SceneHash_desc, bytes);
    case Step::Difference: return receive<Difference>(stadion_wire_Difference_desc, bytes);
    case Step::StatePart: return receive<StatePart>(stadion_wire_StatePart_desc, bytes);
    case Step::Left: return lead_->left(figure, bytes.size() > 1 ? bytes[1] : 0);
    case Step::Join: return join();
    case Step::Next: return next();
    case Step::Show: return show();
    case Step::Issue: return issue(figure);
    case Step::Simulated: return lead_->simulated(figure, figure);
    case Step::TakeOver: return takeOver();
    case Step::Begin: return begin();
    case Step::Count: break;
    }
  }

private:
  template <class T>
  void receive(const dds_topic_descriptor_t& type, Bytes bytes) {
    const Packet<T> packet(type, bytes);
    if (!packet) return;
    static_cast<BusListener&>(*lead_).receive(*packet);
    static_cast<BusListener&>(*follower_).receive(*packet);
  }

  void join() {
    const auto joining = follower_->join();
    require(!joining || (joining->rate >= 1 && joining->rate <= 1000), "a show has a rate");
  }

  void takeOver() {
    if (lead_->hasBegun() || std::exchange(issued_, true)) return;
    const auto underWay = lead_->takeOver();
    require(!underWay || (underWay->state && underWay->last.time >= 0), "a show that goes on has a scene");
  }

  void begin() {
    if (!lead_->hasBegun()) lead_->begin(60);
  }

  void next() {
    const auto order = follower_->next();
    if (!order) return;
    const TimeSignature& now = order->signature;
    require(now.time >= 0 && now.step >= 0 && now.step <= now.time, "a frame has its time");
    require(std::isfinite(order->presentation.eyeSeparation), "eyes are somewhere");
    follower_->input().sampleAt(now.time, input_);
    for (const TrackerSample& t : input_.trackers) {
      require(t.X_RT.finite(), "a tracker is somewhere");
      Nanoseconds before = 0;
      for (const PoseKnot& k : t.knots)
        require(k.X.finite() && k.time >= before, "a way goes on"), before = k.time;
    }
    follower_->simulated(now.frame, 1);
  }

  void show() {
    lead_->mayShow({});
    follower_->mayShow({});
  }

  void issue(std::uint8_t frame) {
    FrameOrder order;
    order.signature = signatureAt(frame, 60);
    issued_ = true;
    lead_->issue(order);
    input_ = lead_->input(inner_).InputDevice::sampleAt(order.signature.time);
  }

  bool issued_ = false;
  ScriptedInput inner_;
  InputSample input_;
  std::unique_ptr<ClusterLeader> lead_ = ClusterLeader::unconnected(
      {room(), {1}, std::chrono::seconds(0), [](const std::string&) {}, [] { return true; }}, 1);
  std::unique_ptr<Follower> follower_ =
      Follower::unconnected({room(), 1, {1}, [](const std::string&) {}, [] { return true; }}, 1);
};

}  // namespace

void cluster_wire(Bytes bytes) {
  Room room;
  while (bytes.size() >= 3) {
    const auto step = static_cast<Step>(bytes[0] % static_cast<std::uint8_t>(Step::Count));
    const std::size_t size = std::min<std::size_t>(bytes.size() - 3, bytes[1] | bytes[2] << 8U);
    room.take(step, bytes.subspan(3, size));
    bytes = bytes.subspan(3 + size);
  }
}

}  // namespace stadion::fuzz
