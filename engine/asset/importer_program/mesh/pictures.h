#pragma once
/// The pictures of one model, each read once.

#include "engine/asset/importer_program/mesh/materials.h"

#include <map>

namespace stadion::importer {

/// What a material makes of a picture's alpha.
enum class AlphaUse : std::uint8_t { Ignored, Kept };

/// Adds the pictures that materials ask for to a mesh.
///
/// Errors   A picture that cannot be read gives -1, and one line in the inventory.
class Pictures {
public:
  Pictures(const SourceScene& scene, const PictureSource& source, Mesh& mesh, ModelInventory& inventory)
      : scene_(scene), source_(source), mesh_(mesh), inventory_(inventory),
        budget_(source.limits.textureBytes) {}

  /// Returns the index into the mesh's textures, or -1 if the picture cannot be read.
  std::int32_t get(std::int32_t image, AlphaUse alpha);
  /// The picture `image` (white if -1) with its alpha from the picture `opacity`.
  std::int32_t getWithOpacity(std::int32_t image, std::int32_t opacity);

  /// Roughness in green and metallic in blue, each from the red of its picture; white where the number is -1.
  std::int32_t getMetallicRoughness(std::int32_t roughness, std::int32_t metallic);

private:
  enum class Use : std::uint8_t { Alone, Opacity, MetallicRoughness };
  struct Key {
    std::int32_t image, second;
    AlphaUse alpha;
    Use use;
    auto operator<=>(const Key&) const = default;
  };
  bool read(std::int32_t image, Texture& texture);
  bool readFrom(const SourceImage& image, Texture& texture, std::string& why);
  bool readFile(const SourceImage& image, Texture& texture, std::string& why);
  bool unpack(const SourceImage& image, Texture& texture, std::string& why);
  std::int32_t add(Texture texture);

  const SourceScene& scene_;
  const PictureSource& source_;
  Mesh& mesh_;
  ModelInventory& inventory_;
  std::uint64_t budget_;
  std::map<Key, std::int32_t> known_;
  std::map<std::int32_t, bool> unreadable_;  ///< by image: it is in the inventory already
};

}  // namespace stadion::importer
