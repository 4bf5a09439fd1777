#pragma once
/// Prepares scene files while the show runs, on a thread of its own: reads, checks, imports meshes, builds
/// nodes, writes the static chunk. App only installs the result.
///
/// Threads   one loader thread; request, take, dispose and shown are App's.
/// Errors    Errors in a file go to the report function, on the loader's thread, or on App's when the show is
///           opened; the show goes on. take() throws the loader thread's exceptions again, with the file's
///           name.
///
/// A load takes effect when it is due, and take() waits for it. In a live show, a load that is not ready
/// takes effect in the first frame in which it is ready. That decision is reported, so that it can be
/// recorded. A replay gets these decisions and applies them.

#include "engine/asset/import.h"
#include "engine/build/builder.h"
#include "engine/scene/loaded_scene.h"
#include "engine/script/script_texts.h"
#include "pipeline/load/imported_meshes.h"
#include "pipeline/state/chunk_arena.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace stadion {

struct LoaderParts {
  MeshStore& meshes;
  ChunkArena& arena;
  Importer& importer;
  const AssetRoots& roots;
  const NodeRegistry& types;
  NodeServices& services;  ///< services for the nodes of this show
  std::function<void(const Diagnostics&)> report;
  const std::atomic<bool>* stop = nullptr;  ///< once true, no call waits for a load any more
  Nanoseconds step = 0;                 ///< frame duration, to warn of shorter latencies [ns]; 0: no warning
  std::vector<std::string> trackers{};  ///< devices of the input log, to warn of other names
  std::string log{};                    ///< the input log; empty: the devices are not known in advance
  ImportedMeshes* kept = nullptr;       ///< models that need not be imported again; null: none
  /// The scripts' texts at this point; null: each file is read when it is loaded.
  std::shared_ptr<const ScriptTexts> texts{};
};

class Loader final : public SceneLoader {
public:
  explicit Loader(LoaderParts parts);
  ~Loader() override;

  /// Called for each late load, with its number and the show time at which it takes effect.
  using LateLoad = std::function<void(std::uint32_t, Nanoseconds)>;
  void tellLateLoads(LateLoad told) { late_ = std::move(told); }
  /// Sets a function that App calls when it begins to wait for files (true), and when it has them (false).
  void tellWaiting(std::function<void(bool)> told) { waitsTold_ = std::move(told); }
  /// Declares the show live: late loads do not stop it. Call it before the first frame.
  void playLive() { live_ = true; }
  /// Returns the loads that are due and have not yet taken effect.
  std::vector<std::uint32_t> overdue() const;
  /// Declares the show a replay: these loads came late. Call it before the first frame.
  void replay(std::map<std::uint32_t, Nanoseconds> late) { decided_ = std::move(late); }

  void request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine& X_WO) override;
  bool takesEffect(std::uint32_t number, Nanoseconds now) override;
  std::unique_ptr<LoadedScene> take(std::uint32_t number) override;
  void dispose(std::unique_ptr<LoadedScene> load, std::uint64_t lastFrame) override;
  void report(const Diagnostic& finding) override;
  std::string plugins() const override { return parts_.types.pluginsInWords(); }

  /// Models that scripts loaded so far make transparent. Any thread. Ids of models that are gone may be among them.
  std::vector<MeshId> fadingMeshes();
  /// Reports that all walls have shown `frame`: objects disposed of up to it may be freed.
  void shown(std::uint64_t frame);

private:
  struct Prepared {
    std::unique_ptr<LoadedScene> load;
    std::exception_ptr thrown;
  };
  struct Job {
    std::uint32_t number;
    std::string file;
    NodeRef owner;
    Affine X_WO;
    std::map<std::uint32_t, Prepared>::node_type
        place;  ///< among done_: taken early, while App can still be notified
  };
  struct Garbage {
    std::unique_ptr<LoadedScene> load;
    std::uint64_t lastFrame;
  };
  /// The part of a file that its sub-scenes need to resolve outer names. Kept only for files with sub-scenes.
  struct Around {
    std::uint32_t outer = 0;  ///< the enclosing load
    std::unique_ptr<const Document> document;
  };

  /// The models of one load, each imported and counted once.
  struct Imports {
    /// File, unit, up axis, levels, as a figure, nodes.
    using Key = std::tuple<std::string, double, int, double, bool, std::string>;
    std::map<Key, MeshId> known;
    std::vector<MeshId> counted;

    MeshId of(const Declaration& d, Loader& loader, Diagnostics& findings);
  };

  void work();
  Prepared prepareSafely(const Job& job);
  bool stopped() const { return parts_.stop && *parts_.stop; }
  Result<SourceText> read(const Job& job);
  Diagnostic askedForBy(const Job& job, Diagnostic d) const;
  std::unique_ptr<LoadedScene> prepare(const Job& job);
  std::unique_ptr<LoadedScene> build(const Job& job, std::unique_ptr<Document> document,
                                     Diagnostics& findings);
  std::optional<ImportedMeshes::Key> keyOf(const std::string& file, const ImportOptions& options,
                                           std::uint32_t levels) const;
  MeshId importMesh(const Declaration& d, const ImportOptions& options, Diagnostics& findings);
  Nanoseconds soundLength(const Declaration& d, Diagnostics& findings);
  void destroy(std::unique_ptr<LoadedScene> load);
  std::vector<std::uint32_t> around(std::uint32_t outer) const;

  LoaderParts parts_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  std::map<std::uint32_t, Prepared> done_;
  std::exception_ptr thrown_;                         ///< outside a preparation
  std::deque<Garbage> waiting_;                       ///< until their last frame is shown
  std::deque<std::unique_ptr<LoadedScene>> garbage_;  ///< may be freed
  std::vector<MeshId> fading_;
  bool ending_ = false;
  std::map<std::uint32_t, Around> around_;  ///< the loader thread's own
  bool live_ = false;                       ///< from here to `decided_`: used by App only
  LateLoad late_;
  std::function<void(bool)> waitsTold_;
  std::map<std::uint32_t, Nanoseconds> decided_;
  std::map<std::uint32_t, Nanoseconds> awaited_;  ///< due and skipped; the show time of the last skip
  std::thread thread_;
};

}  // namespace stadion
