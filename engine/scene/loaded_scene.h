#pragma once
/// One loaded file: its nodes, its names, its static objects.
///
/// The loader thread prepares a load, and App installs it before the frame in which its show time falls. App
/// removes it after the frame in which it ends, and the loader thread destroys it. Dynamics knows both times
/// exactly.
///
/// Ownership  owns its nodes.
/// Threads    one at a time: the loader's until it is installed, then App's.
/// Errors     of the file are reported when it is prepared.

#include "engine/base/diagnostic.h"
#include "engine/core/cost_budget.h"
#include "engine/published/records.h"
#include "engine/scene/node.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stadion {

/// A plain object that nothing in its file moves. It has no node, only a record in the load's static chunk.
/// There may be a million of them, so rare properties are stored elsewhere.
struct StaticObject {
  std::uint32_t position = 0;  ///< in its file
  NodeRef parent;
};

struct LoadedScene {
  std::uint32_t number = 0;  ///< from 1, in the order of requests
  std::string file;
  std::uint64_t script = 0;  ///< hash of what is in it
  NodeRef owner;             ///< the scene node that asked for it; invalid = the show itself
  Nanoseconds since = 0;     ///< time of installation [ns]
  /// Time of unloading [ns], once that is in the present frame.
  Nanoseconds until = std::numeric_limits<Nanoseconds>::max();

  Affine X_WO = Affine::Identity();  ///< owner at the request: places static objects

  std::vector<std::unique_ptr<Node>> nodes;              ///< by position in file; null for static objects
  std::vector<std::uint32_t> enterOrder;                 ///< positions of the nodes, parents first
  std::unordered_map<std::string, std::uint32_t> names;  ///< name to position
  std::vector<std::uint32_t> lines;                      ///< source line by position

  ChunkId chunk = kNoChunk;
  bool chunkShown = false;                       ///< set by the scene's publisher
  std::span<const InstanceRecord> chunkRecords;  ///< in published memory, immutable
  const NodeType* staticType = nullptr;          ///< type of the static objects, if there are any
  std::vector<StaticObject> statics;             ///< parallel to chunkRecords, ordered by position
  std::vector<std::pair<std::uint32_t, const std::string*>>
      staticNames;                           ///< position to key in `names`, of those that have one, in order
  std::map<std::uint32_t, NodeTerms> terms;  ///< position to what a node may cost, of those that say so
  std::vector<MeshId> meshes;  ///< meshes of the load, each counted once; released with the load

  /// Returns the name of a static object.
  std::string nameOf(const StaticObject& object) const {
    const auto at = std::ranges::lower_bound(staticNames, object.position, {},
                                             &std::pair<std::uint32_t, const std::string*>::first);
    return at != staticNames.end() && at->first == object.position ? *at->second : std::string();
  }
  NodeRef find(const std::string& name) const {
    const auto at = names.find(name);
    return at == names.end() ? NodeRef{} : NodeRef{number, at->second};
  }
};

/// Prepares loads beside the running show.
///
/// Threads  called by App; does its work elsewhere.
class SceneLoader {
public:
  virtual ~SceneLoader() = default;
  /// Begins to prepare `file` as load `number`, below `owner`, which is at X_WO now.
  virtual void request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine& X_WO) = 0;
  /// Returns true if the load, which is due, takes effect in the frame of show time `now`. If it always does,
  /// take() waits for late loads. If not (live shows and their replays), the scene asks again in the next
  /// frame.
  virtual bool takesEffect(std::uint32_t number, Nanoseconds now) {
    static_cast<void>(number);
    static_cast<void>(now);
    return true;
  }
  /// Returns the load and waits until it is ready; null if it could not be loaded and the reason was
  /// reported. Throws what the preparation threw, and RunStopped if the run ends while it waits.
  virtual std::unique_ptr<LoadedScene> take(std::uint32_t number) = 0;
  /// Destroys a removed load, once no frame up to `lastFrame` needs it.
  virtual void dispose(std::unique_ptr<LoadedScene> load, std::uint64_t lastFrame) = 0;
  /// The plugins whose node types a file may use, in words; empty: none.
  virtual std::string plugins() const { return {}; }
  /// Reports to the author what was found while the show runs.
  virtual void report(const Diagnostic&) {}
};

}  // namespace stadion
