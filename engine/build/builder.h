#pragma once
/// From a checked document to a load: each node is made as its type says, plain objects are put into the
/// static chunk.
///
/// Threads  the loader's; touches nothing that App uses.

#include "engine/asset/mesh_store.h"
#include "engine/base/diagnostic.h"
#include "engine/build/node_request.h"
#include "engine/scene/loaded_scene.h"
#include "engine/script/document.h"

#include <functional>
#include <memory>

namespace stadion {

/// Returns the mesh for a declaration's file; never kNoMesh. The source also counts its uses.
using MeshSource = std::function<MeshId(const Declaration&)>;

/// Gives the length of a declaration's sound file, of a silent stand-in if it cannot be read [ns].
using SoundSource = std::function<Nanoseconds(const Declaration&)>;

struct BuildInput {
  const Document& document;
  std::uint32_t number;  ///< number of the load
  NodeRef owner;
  Affine X_WO = Affine::Identity();         ///< where the owner is
  std::vector<std::uint32_t> surroundings;  ///< load numbers of the files around it, nearest first
  NodeServices& services;
  MeshSource meshes;
  const MeshStore& store;
  SoundSource sounds;
};

struct Built {
  std::unique_ptr<LoadedScene> load;          ///< without its chunk and its list of meshes
  std::vector<InstanceRecord> staticRecords;  ///< parallel to load->statics
  std::vector<MeshId> fading;                 ///< that attributes or messages of the file make transparent
};

Built buildLoad(const BuildInput& input, Diagnostics& findings);

}  // namespace stadion
