#pragma once
/// Model files to meshes, safely.
///
/// The work is done by a second program, `stadion-import`, under limits of memory and time (see
/// importer_program/main.cpp). It is started at the first import, reads one file after another and is
/// replaced after a fault.
///
/// Frames   the mesh's own frame: +Z up, metres (see format.h).
/// Threads  load() may be called from any thread; imports wait for each other.
/// Errors   one sentence, with the script's position when it was given. The show survives every file.

#include "engine/asset/format.h"
#include "engine/asset/importer_process.h"
#include "engine/asset/inventory.h"
#include "engine/asset/mesh.h"
#include "engine/asset/roots.h"
#include "engine/base/diagnostic.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace stadion {

struct ImportLimits {
  std::chrono::milliseconds timeout{10'000};           ///< [ms] for one file
  std::uint64_t addressSpace = 1536ull * 1024 * 1024;  ///< [bytes] of the importer program
  std::uint64_t fileBytes = 512ull * 1024 * 1024;      ///< [bytes] of one file
  std::uint32_t nodeDepth = 256;
  MeshLimits mesh;
  const std::atomic<bool>* giveUp = nullptr;  ///< once true, imports end at once, without a mesh
};

class Importer {
public:
  Importer(std::filesystem::path program, AssetRoots roots, ImportLimits limits = {});

  /// The mesh in the file `name` below the asset roots. Content that is approximated or left out (a missing
  /// texture, a light, a clip) is no failure: it is added to `losses` as warnings. `inventory` gets all of the
  /// file's content.
  Result<std::unique_ptr<Mesh>> load(const std::string& name, const ImportOptions& options = {},
                                     const SourcePosition& where = {}, Diagnostics* losses = nullptr,
                                     ModelInventory* inventory = nullptr);

  /// `stadion-import` of this copy of Stadion (helperProgram).
  static std::filesystem::path installedProgram();

  /// How many importer programs have been started so far.
  int started() const;
  /// Process id of the running importer, 0 if none.
  int pid() const;

private:
  AssetRoots roots_;
  ImportLimits limits_;
  mutable std::mutex mutex_;
  ImporterProcess process_;
};

/// Returns the replacement for an asset that could not be loaded: a box of 0.5 m in black and magenta checks,
/// standing on the origin.
std::unique_ptr<Mesh> standIn(const std::string& name);

}  // namespace stadion
