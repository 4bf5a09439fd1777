#pragma once
/// What the maker of a node (NodeType::make) is given.

#include "engine/asset/mesh.h"
#include "engine/base/diagnostic.h"
#include "engine/build/node_services.h"
#include "engine/maths/srgb.h"
#include "engine/scene/object_node.h"
#include "engine/script/document.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// A declared model where its file puts it.
struct PlacedModel {
  const Mesh* mesh = nullptr;
  Appearance appearance;
  Affine X_WN = Affine::Identity();
};

struct NodeRequest {
  Declaration declaration;
  NodeRef self;
  std::string name;
  PlaceAttributes place;
  Appearance appearance;
  const Mesh* mesh = nullptr;  ///< mesh; for types with Trait::Model or Trait::Figure
  const std::function<NodeRef(const NodeReference&)>& resolve;
  /// Returns the placed model of an object in the same file.
  const std::function<std::optional<PlacedModel>(const NodeReference&)>& model;
  Diagnostics& findings;
  NodeServices& services;
  Nanoseconds soundLength = 0;      ///< length of the sound; for types with Trait::Sound [ns]
  MeshId surroundings = kNoMesh;    ///< of the picture, if one was stated and read; for Trait::Surroundings
  std::vector<NodeRef> children{};  ///< children with Trait::Level, in the order of the file

  const NodeType& type() const { return declaration.type().type(); }
};

/// A colour as scripts write it (sRGB, 0 to 1) in linear light.
template <class Linear>
void setColour(const Vec3& srgb, Linear& linear, double factor = 1) {
  for (unsigned i = 0; i < 3; ++i) linear[i] = static_cast<float>(linearFromSrgb(srgb[i]) * factor);
}

}  // namespace stadion
