#pragma once
/// Light from all around, and how light becomes a picture.

#include "engine/nodes/faded_value.h"
#include "engine/nodes/switch_state.h"
#include "engine/published/records.h"
#include "engine/scene/node.h"

namespace stadion {

/// `environment`: a picture of surroundings, or the show's own sky, gives light to matt surfaces and is seen in
/// shiny ones. Of those that are enabled, the last one to enter counts.
/// Commands  enable, disable, toggle; intensity.
extern const NodeType kEnvironmentType;

class EnvironmentNode : public Node {
public:
  EnvironmentNode(NodeRef self, std::string name, const EnvironmentRecord& record, double intensity, bool on)
      : Node(kEnvironmentType, self, std::move(name)), record_(record), switch_(on), intensity_(intensity) {}

  bool busy() const override { return fades_; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("switch", self.switch_), f("intensity", self.intensity_);
    f.unhashed("fades", self.fades_);
  }
  bool resume(Scene& scene) override;

  static constexpr double kMostIntensity = 1e4;

private:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;
  EnvironmentRecord recordAt(Nanoseconds time) const;

  EnvironmentRecord record_;  ///< without its switch and intensity
  SwitchState switch_;
  FadedValue intensity_;
  bool fades_ = false;
};

/// `tones`: the exposure of the show's pictures, and the curve that bends bright light. The last one to enter
/// counts.
/// Commands  exposure.
extern const NodeType kTonesType;

class TonesNode : public Node {
public:
  TonesNode(NodeRef self, std::string name, ToneCurve curve, double exposure)
      : Node(kTonesType, self, std::move(name)), curve_(curve), exposure_(exposure) {}

  bool busy() const override { return fades_; }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("exposure", self.exposure_);
    f.unhashed("fades", self.fades_);
  }
  bool resume(Scene& scene) override;

  static constexpr double kMostStops = 20;

private:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;
  TonesRecord recordAt(Nanoseconds time) const;

  ToneCurve curve_;
  FadedValue exposure_;  ///< [stops]
  bool fades_ = false;
};

}  // namespace stadion
