#pragma once
/// The lights, the sky, environments and tones of a scene, and which of them are published.
///
/// At most kMostLights shine at a time: the brightest at the visitor's head, among equals the first node. If
/// more are on, the author is warned once.
///
/// Frames     lights are given in node coordinates and published in World.
/// Ownership  borrows placements, tree and loader.
/// Threads    App only.
/// Errors     expects handles that exist; consistent() checks those of a restored snapshot.

#include "engine/published/records.h"
#include "engine/scene/placements.h"
#include "engine/scene/scene_tree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace stadion {

/// Records of nodes of which only the last one counts; when it leaves, the one before returns.
template <class Record>
class LastRecords {
public:
  void add(NodeRef node, const Record& record) { all_.push_back({node, record}); }
  void set(NodeRef node, const Record& record) {
    for (Entry& e : all_)
      if (e.node == node) e.record = record;
  }
  void remove(NodeRef node) {
    std::erase_if(all_, [&](const Entry& e) { return e.node == node; });
  }
  /// The last record for which `counts` is true; else the standard one.
  template <class Counts>
  Record last(const Counts& counts) const {
    const auto at =
        std::find_if(all_.rbegin(), all_.rend(), [&](const Entry& e) { return counts(e.record); });
    return at == all_.rend() ? Record{} : at->record;
  }
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("nodes", self.all_);
  }

private:
  struct Entry {
    NodeRef node;
    Record record;

    template <class Self, class Fields>
    static void fields(Self& e, Fields& f) {  // the node restores the rest
      f("node", e.node);
    }
  };
  std::vector<Entry> all_;  ///< in the order in which their nodes entered
};

class Lights {
public:
  Lights(const Placements& placements, const SceneTree& tree, SceneLoader& loader)
      : placements_(placements), tree_(tree), loader_(loader) {}

  // For nodes.

  std::size_t add(PlacementId placement, const LightRecord& local, NodeRef node);
  void set(std::size_t handle, const LightRecord& local, bool on);
  void remove(std::size_t handle);
  /// Returns true if the light exists and belongs to `node`; nodes ask this when they are restored.
  bool owns(std::size_t handle, NodeRef node) const {
    return handle < lights_.size() && lights_[handle].live && lights_[handle].node == node;
  }
  void addSky(NodeRef node, const SkyRecord& sky) { skies_.push_back({node, sky}); }
  void setSky(NodeRef node, const SkyRecord& sky);
  void removeSky(NodeRef node);
  /// Of several environments that are lit, the last one counts.
  LastRecords<EnvironmentRecord>& environments() { return environments_; }
  LastRecords<TonesRecord>& tones() { return tones_; }
  /// The node whose sky is seen: the last one; invalid: the standard sky.
  NodeRef sky() const { return skies_.empty() ? NodeRef{} : skies_.back().node; }

  // For the scene.

  /// Says that the placement moved or changed its visibility.
  void moved(PlacementId placement) { changed_ |= placement < at_.size() && at_[placement] > 0; }
  void moved(std::span<const PlacementId> placements) {
    for (std::size_t i = 0; i < placements.size() && !at_.empty(); ++i) moved(placements[i]);
  }
  /// Returns true if publish() has anything to do.
  bool due() const { return changed_ || !shining_.empty(); }
  /// Publishes all lights that shine, if they changed. The head is at p_WH.
  void publish(const Vec3& p_WH, ChangeSet& changes);
  SkyRecord skyRecord() const;

  void stateOfLights(StateFields& f);
  void stateOfSkies(StateFields& f);
  bool consistent() const;
  void resume() { changed_ = true; }

private:
  struct Light {
    PlacementId placement = kNoPlacement;
    LightRecord local;
    NodeRef node;
    bool on = true, live = false;

    template <class Self, class Fields>
    static void fields(Self& l, Fields& f) {  // the node restores the rest
      f("placement", l.placement), f("node", l.node), f("on", l.on), f("live", l.live);
    }
  };
  struct Sky {
    NodeRef node;
    SkyRecord record;

    template <class Self, class Fields>
    static void fields(Self& s, Fields& f) {
      f("node", s.node);
    }
  };

  void findWanted();
  void choose(const Vec3& p_WH);
  LightRecord inWorld(const Light& light) const;
  void warnOfTooMany();

  const Placements& placements_;
  const SceneTree& tree_;
  SceneLoader& loader_;
  std::vector<Light> lights_;      ///< by handle
  std::vector<std::uint32_t> at_;  ///< number of lights by placement
  bool changed_ = true;
  std::vector<std::size_t> wanted_;   ///< handles of lights that are on and shown
  std::vector<std::size_t> chosen_;   ///< handles in `wanted_` of the lights that shine, at most kMostLights
  std::vector<std::size_t> shining_;  ///< published last, while more than kMostLights are wanted
  std::vector<std::pair<double, std::size_t>> brightest_;
  bool warned_ = false;     ///< a warning of too many lights has been given
  std::vector<Sky> skies_;  ///< the last one is seen
  LastRecords<EnvironmentRecord> environments_;
  LastRecords<TonesRecord> tones_;
};

}  // namespace stadion
