#pragma once
/// Finds the light that surrounds a list's objects: of a picture, or of the sky's own colours.
///
/// Cost     the light of a sky is made once for its colours, in some milliseconds; that of a picture comes ready
///          from the importer.
/// Threads  any. What find() returns stays valid when the store frees the picture.

#include "engine/asset/mesh_store.h"
#include "pipeline/draw_list/draw_list.h"

#include <memory>
#include <mutex>

namespace stadion {

class EnvironmentLights {
public:
  explicit EnvironmentLights(const MeshStore& store) : store_(store) {}

  /// Null: nothing surrounds them, and the sky's `ambient` lights. A picture that the store has freed counts as
  /// none.
  std::shared_ptr<const EnvironmentLight> find(const DrawSky& sky);

private:
  const MeshStore& store_;
  std::mutex mutex_;
  std::array<Radiance, 3> colours_{};  ///< zenith, horizon and ground of `ofSky_`
  std::shared_ptr<const EnvironmentLight> ofSky_;
};

}  // namespace stadion
