#include "engine/asset/importer_program/mesh/pictures.h"

#include "engine/asset/importer_program/mesh/picture_decoder.h"
#include "engine/asset/importer_program/source/model_files.h"
#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>

namespace stadion::importer {
namespace {

bool hasAlpha(const Texture& texture) {
  for (std::size_t i = 3; i < texture.rgba.size(); i += 4)
    if (texture.rgba[i] != 255) return true;
  return false;
}

/// Opacity of a pixel: its alpha if the picture has any, else its brightness.
std::uint8_t opacityAt(const Texture& from, std::size_t pixel, bool alpha) {
  const std::uint8_t* p = from.rgba.data() + 4 * pixel;
  return alpha ? p[3] : static_cast<std::uint8_t>((p[0] + p[1] + p[2]) / 3);
}

/// Red of the pixel of `from` that lies nearest to a pixel of `to`.
std::uint8_t redAt(const Texture& from, std::size_t x, std::size_t y, const Texture& to) {
  return from.rgba[4 * (y * from.height / to.height * from.width + x * from.width / to.width)];
}

/// The nearest pixel of `opacity` gives the alpha of each pixel of `to`.
void setAlpha(const Texture& opacity, Texture& to) {
  const bool alpha = hasAlpha(opacity);
  for (std::size_t y = 0; y < to.height; ++y)
    for (std::size_t x = 0; x < to.width; ++x) {
      const std::size_t from = y * opacity.height / to.height * opacity.width + x * opacity.width / to.width;
      to.rgba[4 * (y * to.width + x) + 3] = opacityAt(opacity, from, alpha);
    }
}

}  // namespace

std::int32_t Pictures::get(std::int32_t image, AlphaUse alpha) {
  const Key key{image, -1, alpha, Use::Alone};
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  Texture texture;
  if (!read(image, texture)) return known_[key] = -1;
  if (alpha == AlphaUse::Ignored)
    for (std::size_t i = 3; i < texture.rgba.size(); i += 4) texture.rgba[i] = 255;
  return known_[key] = add(std::move(texture));
}

std::int32_t Pictures::getWithOpacity(std::int32_t image, std::int32_t opacity) {
  const Key key{image, opacity, AlphaUse::Kept, Use::Opacity};
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  Texture mask, texture;
  if (!read(opacity, mask)) return known_[key] = image < 0 ? -1 : get(image, AlphaUse::Kept);
  if (image >= 0) {
    if (!read(image, texture)) return known_[key] = -1;
    if (texture.width != mask.width || texture.height != mask.height)
      inventory_.add(ContentUse::Approximated, "the opacity map " + inQuotes(mask.name) +
                                                   ": its size is that of " + inQuotes(texture.name));
  } else {
    texture = mask;
    std::ranges::fill(texture.rgba, std::uint8_t{255});
  }
  setAlpha(mask, texture);
  return known_[key] = add(std::move(texture));
}

std::int32_t Pictures::getMetallicRoughness(std::int32_t roughness, std::int32_t metallic) {
  const Key key{roughness, metallic, AlphaUse::Ignored, Use::MetallicRoughness};
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  Texture rough, metal;
  const bool hasRough = roughness >= 0 && read(roughness, rough),
             hasMetal = metallic >= 0 && read(metallic, metal);
  if (!hasRough && !hasMetal) return known_[key] = -1;
  if (hasRough && hasMetal && (rough.width != metal.width || rough.height != metal.height))
    inventory_.add(ContentUse::Approximated, "the metallic map " + inQuotes(metal.name) +
                                                 ": its size is that of " + inQuotes(rough.name));
  Texture both = hasRough ? rough : metal;
  for (std::size_t y = 0; y < both.height; ++y)
    for (std::size_t x = 0; x < both.width; ++x) {
      std::uint8_t* to = both.rgba.data() + 4 * (y * both.width + x);
      const std::uint8_t green = hasRough ? redAt(rough, x, y, both) : 255;
      const std::uint8_t blue = hasMetal ? redAt(metal, x, y, both) : 255;
      to[0] = 255, to[1] = green, to[2] = blue, to[3] = 255;
    }
  return known_[key] = add(std::move(both));
}

std::int32_t Pictures::add(Texture texture) {
  mesh_.textures.push_back(std::move(texture));
  return static_cast<std::int32_t>(mesh_.textures.size() - 1);
}

bool Pictures::read(std::int32_t index, Texture& texture) {
  const SourceImage& image = scene_.images[static_cast<std::size_t>(index)];
  texture.name = image.name;
  std::string why = "is one picture too many";
  if (mesh_.textures.size() < source_.limits.textures && readFrom(image, texture, why)) return true;
  if (!std::exchange(unreadable_[index], true))
    inventory_.add(ContentUse::LeftOut, "the texture " + inQuotes(image.name) + ": it " + why);
  return false;
}

bool Pictures::readFrom(const SourceImage& image, Texture& texture, std::string& why) {
  if (image.width > 0) return unpack(image, texture, why);
  if (!image.file.empty()) return readFile(image, texture, why);
  why = "is empty";
  return !image.bytes.empty() && decodePicture(image.bytes, source_.limits, budget_, texture, why);
}

bool Pictures::readFile(const SourceImage& image, Texture& texture, std::string& why) {
  auto bytes = readBeneath(source_.root, source_.folder + image.file, source_.fileBytes, &why);
  for (const std::string& other : image.otherPlaces)
    if (!bytes) bytes = readBeneath(source_.root, source_.folder + other, source_.fileBytes);
  return bytes && decodePicture(*bytes, source_.limits, budget_, texture, why);
}

bool Pictures::unpack(const SourceImage& image, Texture& texture, std::string& why) {
  const std::uint64_t bytes = std::uint64_t{image.width} * image.height * 4;
  why = "is too large";
  if (std::max(image.width, image.height) > source_.limits.textureSide || bytes > budget_) return false;
  budget_ -= bytes;
  texture.width = image.width;
  texture.height = image.height;
  texture.rgba = image.bytes;
  return true;
}

}  // namespace stadion::importer
