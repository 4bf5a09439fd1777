#pragma once
/// From a checked document to a load: nodes made by the factories of their kinds, plain objects put into the
/// static chunk.
///
/// Threads  the loader's; touches nothing that App uses.

#include "engine/asset/mesh_store.h"
#include "engine/base/diagnostic.h"
#include "engine/scene/load.h"
#include "engine/scene/object_node.h"
#include "engine/script/document.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>

namespace stadion {

/// A declared model where its file puts it.
struct PlacedModel {
  const Mesh* mesh = nullptr;
  Appearance appearance;
  Affine X_WN = Affine::Identity();
};

/// Everything a factory may need to make one node.
struct NodeRequest {
  Declaration declaration;
  NodeRef self;
  std::string name;
  PlaceAttributes place;
  Appearance appearance;
  const Mesh* mesh = nullptr;  ///< of kinds with a model
  const std::function<NodeRef(const NodeReference&)>& resolve;
  /// Of objects in the same file.
  const std::function<std::optional<PlacedModel>(const NodeReference&)>& model;
  Diagnostics& findings;
  Nanoseconds soundLength = 0;      ///< of sounds [ns]
  std::vector<NodeRef> children{};  ///< of lod nodes: what it chooses from, in the order of the script
};

/// Makes a node, or says in the findings why it cannot.
using NodeFactory = std::function<std::unique_ptr<Node>(const NodeRequest&)>;
using NodeFactories = std::array<NodeFactory, kNodeKindCount>;

/// Fills in the kinds that need neither dynamics nor anything above this floor.
void addEngineFactories(NodeFactories& factories);

/// Gives the mesh for a declaration's file; never kNoMesh. Who gives it keeps count of it, too.
using MeshSource = std::function<MeshId(const Declaration&)>;

/// Gives the length of a declaration's sound file, of a silent stand-in if it cannot be read [ns].
using SoundSource = std::function<Nanoseconds(const Declaration&)>;

struct BuildInput {
  const Document& document;
  std::uint32_t number;  ///< of the load
  NodeRef owner;
  Affine X_WO = Affine::Identity();         ///< where the owner is
  std::vector<std::uint32_t> surroundings;  ///< load numbers of the files around it, nearest first
  const NodeFactories& factories;
  MeshSource meshes;
  const MeshStore& store;
  SoundSource sounds;
};

struct Built {
  std::unique_ptr<Load> load;                 ///< without its chunk and its list of meshes
  std::vector<InstanceRecord> staticRecords;  ///< parallel to load->statics
};

Built buildLoad(const BuildInput& input, Diagnostics& findings);

}  // namespace stadion
