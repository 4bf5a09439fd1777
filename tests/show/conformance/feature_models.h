#pragma once
// glTF models for the comparison with an independent renderer: each shows one feature, or one combination.

#include "tests/engine/asset/gltf_builder.h"

#include <string>
#include <vector>

namespace stadion::test {

struct FeatureModel {
  std::string name;
  GltfBuilder model;
  std::string clip{};     ///< plays this clip; empty: an object
  double time = 0;        ///< of the clip [s]
  bool reflects = false;  ///< light from all sides is reflected as well
  /// Limits of the difference away from edges, in linear light, of 255.
  double mean = 1, worst = 6;
};

/// At least 60.
std::vector<FeatureModel> featureModels();

/// Balls of each roughness and metallic factor that a picture of surroundings is to light.
std::vector<FeatureModel> surroundedBalls();

}  // namespace stadion::test
