#pragma once
/// Prepares scene files beside the running show, on a thread of its own: reads, checks, imports meshes,
/// builds nodes, writes the static chunk. App only installs the result.
///
/// Threads   one worker; request, take, dispose and shown are App's.
/// Errors    go to the report function (on the worker's thread, or App's when the show is opened); the show
/// goes on.

#include "engine/asset/import.h"
#include "engine/scene/load.h"
#include "engine/script/builder.h"
#include "pipeline/state/chunk_arena.h"

#include <condition_variable>
#include <deque>
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
  const NodeFactories& factories;
  std::function<void(const Diagnostics&)> report;
};

class Loader final : public SceneLoader {
public:
  explicit Loader(LoaderParts parts);
  ~Loader() override;

  void request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine& X_WO) override;
  std::unique_ptr<Load> take(std::uint32_t number) override;
  void dispose(std::unique_ptr<Load> load, std::uint64_t lastFrame) override;
  void report(const Diagnostic& finding) override;

  /// All walls have shown `frame`: what was disposed of up to it may go.
  void shown(std::uint64_t frame);

private:
  struct Job {
    std::uint32_t number;
    std::string file;
    NodeRef owner;
    Affine X_WO;
  };
  struct Garbage {
    std::unique_ptr<Load> load;
    std::uint64_t lastFrame;
  };
  /// What a file's sub-scenes need to know of it to resolve names outwards. Kept only of files that have
  /// sub-scenes.
  struct Around {
    std::uint32_t outer = 0;  ///< the load around it
    std::unique_ptr<const Document> document;
  };

  /// The models of one load, each imported and counted once.
  struct Imports {
    using Key = std::tuple<std::string, double, int>;  ///< file, unit, up axis
    std::map<Key, MeshId> known;
    std::vector<MeshId> counted;

    MeshId of(const Declaration& d, Loader& loader, Diagnostics& findings);
  };

  void work();
  Result<SourceText> read(const Job& job) const;
  std::unique_ptr<Load> prepare(const Job& job);
  std::unique_ptr<Load> build(const Job& job, std::unique_ptr<Document> document, Diagnostics& findings);
  MeshId importMesh(const Declaration& d, Diagnostics& findings);
  void destroy(std::unique_ptr<Load> load);
  std::vector<std::uint32_t> around(std::uint32_t outer) const;

  LoaderParts parts_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  std::map<std::uint32_t, std::unique_ptr<Load>> done_;
  std::deque<Garbage> waiting_;                ///< for their last frame to be shown
  std::deque<std::unique_ptr<Load>> garbage_;  ///< may go
  bool ending_ = false;
  std::map<std::uint32_t, Around> around_;  ///< the worker's own
  std::thread worker_;
};

}  // namespace stadion
