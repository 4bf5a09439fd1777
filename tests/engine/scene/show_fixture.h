#pragma once
/// A scene built by hand for tests: loads are prepared by a function, the input is what the test says.

#include "engine/scene/object_node.h"
#include "engine/scene/scene.h"
#include "engine/nodes/group_node.h"

#include <functional>
#include <map>
#include <new>

namespace stadion {

/// Prepares loads in place, at once.
class TestLoader : public SceneLoader {
public:
  using Recipe = std::function<void(LoadedScene&)>;
  std::map<std::string, Recipe> files;
  std::size_t disposed = 0;
  bool lacksMemory = false;                   ///< for what is disposed of
  std::map<std::uint32_t, Nanoseconds> late;  ///< when loads take effect that are not ready when they are due
  std::vector<Diagnostic> reported;

  bool takesEffect(std::uint32_t number, Nanoseconds now) override {
    const auto at = late.find(number);
    return at == late.end() || now >= at->second;
  }
  void request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine&) override {
    auto load = std::make_unique<LoadedScene>();
    load->number = number, load->file = file, load->owner = owner;
    files.at(file)(*load);
    ready_[number] = std::move(load);
  }
  std::unique_ptr<LoadedScene> take(std::uint32_t number) override {
    auto load = std::move(ready_[number]);
    ready_.erase(number);
    return load;
  }
  void dispose(std::unique_ptr<LoadedScene>, std::uint64_t) override {
    ++disposed;
    if (lacksMemory) throw std::bad_alloc();
  }
  void report(const Diagnostic& finding) override { reported.push_back(finding); }

private:
  std::map<std::uint32_t, std::unique_ptr<LoadedScene>> ready_;
};

/// Adds a node to a load under construction and returns it.
template <class T, class... Args>
T& addNode(LoadedScene& load, const std::string& name, Args&&... args) {
  const auto position = static_cast<std::uint32_t>(load.nodes.size());
  auto node = std::make_unique<T>(NodeRef{load.number, position}, name, std::forward<Args>(args)...);
  T& added = *node;
  load.nodes.push_back(std::move(node));
  load.enterOrder.push_back(position);
  if (!name.empty()) load.names[name] = position;
  return added;
}

inline std::unique_ptr<Mesh> unitMesh() {
  auto mesh = std::make_unique<Mesh>();
  mesh->materials.emplace_back();
  mesh->sphere = {Vec3::Zero(), 1.0};
  mesh->hash = 99;
  return mesh;
}

/// A placed node that can be told to move every frame.
class MovingNode : public PlacedNode {
public:
  MovingNode(NodeRef self, std::string name, PlaceAttributes place = {}, bool moving = true,
             MeshId mesh = kNoMesh)
      : PlacedNode(kTransformType, self, std::move(name), std::move(place)), moving_(moving),
        mesh_(mesh) {}
  bool busy() const override { return moving_ || PlacedNode::busy(); }

protected:
  void onEnter(Scene& scene) override {
    PlacedNode::onEnter(scene);
    if (mesh_ != kNoMesh) instance_ = scene.instances().add(placement(), mesh_, true, self());
  }
  void onLeave(Scene& scene) override {
    if (mesh_ != kNoMesh) scene.instances().remove(instance_);
    PlacedNode::onLeave(scene);
  }
  void simulate(FrameContext& frame) override {
    PlacedNode::simulate(frame);
    if (!moving_) return;
    Affine X = Affine::Identity();
    X.translation() = Vec3(toSeconds(frame.now.time), 0, 0);
    place(frame.scene, X);
  }

private:
  bool moving_;
  MeshId mesh_;
  InstanceId instance_ = 0;
};

/// Notes what it is told and when.
class ListeningNode : public Node {
public:
  ListeningNode(NodeRef self, std::string name) : Node(kGroupType, self, std::move(name)) {}
  struct Heard {
    CommandId command;
    Nanoseconds effective;
    std::uint64_t frame;
    NodeRef sender;
  };
  std::vector<Heard> heard;
  std::size_t visits = 0;

protected:
  void receive(const Message& m, FrameContext& frame) override {
    heard.push_back({m.command, frame.effective(m), frame.now.frame, m.sender});
  }
  void simulate(FrameContext&) override { ++visits; }
};

/// Raises an event at given show times.
class SpeakingNode : public Node {
public:
  SpeakingNode(NodeRef self, std::string name, std::vector<Nanoseconds> when)
      : Node(kGroupType, self, std::move(name)), when_(std::move(when)) {}
  bool busy() const override { return !when_.empty(); }

protected:
  void simulate(FrameContext& frame) override {
    std::erase_if(when_, [&](Nanoseconds t) {
      if (t > frame.now.time) return false;
      raise(Event("timesup"), t);
      return true;
    });
  }

private:
  std::vector<Nanoseconds> when_;
};

class ShowFixture {
public:
  explicit ShowFixture(std::size_t threads = 1) : scene(loader, meshes, threads) {}

  TestLoader loader;
  MeshStore meshes;
  Scene scene;
  InputSample input;
  ChangeSet changes;
  double rate = 60;
  std::uint64_t next = 0;

  void frame() {
    const TimeSignature now = signatureAt(next++, rate);
    input.time = now.time;
    scene.advance(now, input, changes, nullptr);
  }
  void frames(std::uint64_t n) {
    for (; n > 0; --n) frame();
  }
  void head(const Vec3& p) { tracker("head", p); }
  void tracker(const std::string& name, const Vec3& p) {
    for (TrackerSample& t : input.trackers)
      if (t.name == name) {
        t.X_RT.p = p;
        return;
      }
    TrackerSample t;
    t.name = name, t.X_RT.p = p;
    input.trackers.push_back(t);
  }
};

inline Notification notify(Event event, const std::string& target, CommandId command, double delay = 0,
                           std::vector<std::string> arguments = {}) {
  return {event, target, command, std::move(arguments), fromSeconds(delay)};
}

}  // namespace stadion
