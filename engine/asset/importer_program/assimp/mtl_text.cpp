#include "engine/asset/importer_program/assimp/obj_statements.h"
#include "engine/asset/importer_program/assimp/obj_text.h"
#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace stadion::importer {
namespace {

std::optional<float> numberIn(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  float value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = error == std::errc{} && end == word.data() + word.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool isMap(std::string_view keyword) {
  return keyword.starts_with("map_") || keyword == "bump" || keyword == "disp" || keyword == "decal" ||
         keyword == "refl" || keyword == "norm";
}

/// Maps that shows draw: only their options matter.
bool isDrawnMap(std::string_view keyword) {
  return keyword == "map_Kd" || keyword == "map_Ke" || keyword == "map_d";
}

/// The options at the beginning of a map statement.
class OptionReader {
public:
  explicit OptionReader(const std::vector<Word>& words) : words_(words) {}

  /// Reads up to the file's name.
  void read() {
    while (at_ + 1 < words_.size() && words_[at_].text.starts_with('-')) {
      const std::string_view name = words_[at_++].text;
      if (name == "-s")
        readVector(scale_);
      else if (name == "-o")
        readVector(offset_);
      else
        readOther(name);
    }
  }

  std::size_t end() const { return at_; }
  const std::vector<std::string>& others() const { return others_; }

  /// An MTL file counts v from the bottom.
  MapOptions options() const {
    MapOptions options;
    options.clamp = clamp_;
    options.transform.scale = scale_;
    options.transform.offset = {offset_[0], 1 - scale_[1] - offset_[1]};
    return options;
  }

private:
  /// One to three numbers; the third has no meaning for a picture.
  void readVector(Float2& to) {
    for (std::size_t k = 0; k < 3 && at_ + 1 < words_.size(); ++k, ++at_) {
      const auto number = numberIn(words_[at_].text);
      if (!number) return;
      if (k < 2) to[k] = *number;
    }
  }

  void readOther(std::string_view name) {
    if (at_ + 1 < words_.size()) {
      const std::string_view value = words_[at_].text;
      if (name == "-clamp") clamp_ = value == "on";
      if (value == "on" || value == "off" || name == "-imfchan" || name == "-type") ++at_;
    }
    while (at_ + 1 < words_.size() && numberIn(words_[at_].text)) ++at_;
    constexpr std::string_view kKnown[]{"-clamp", "-blendu", "-blendv", "-cc", "-type"};
    if (std::ranges::find(kKnown, name) == std::end(kKnown)) others_.emplace_back(name);
  }

  const std::vector<Word>& words_;
  std::size_t at_ = 1;
  Float2 scale_{1, 1}, offset_{0, 0};
  bool clamp_ = false;
  std::vector<std::string> others_;
};

class MaterialText {
public:
  MaterialText(std::string_view text, ObjNotes& notes) : text_(text), from_(text.data()), notes_(notes) {}

  std::optional<std::vector<std::uint8_t>> mended() {
    Statements statements(text_);
    for (std::vector<Word> words; statements.next(words);) {
      if (words.size() < 2) continue;
      if (words[0].text == "newmtl") material_ = restOf(words, 1);
      if (isMap(words[0].text)) readMap(words);
    }
    if (mended_.empty()) return {};
    copyTo(text_.data() + text_.size());
    return std::move(mended_);
  }

private:
  void readMap(const std::vector<Word>& words) {
    OptionReader reader(words);
    reader.read();
    if (reader.end() == 1) return;
    copyTo(words[1].text.data());
    from_ = words[reader.end()].text.data();
    if (!isDrawnMap(words[0].text)) return;
    notes_.options[material_][std::string(words[0].text)] = reader.options();
    for (const std::string& option : reader.others())
      notes_.otherOptions.push_back(option + " of " + inQuotes(material_));
  }

  void copyTo(const char* end) {
    mended_.insert(mended_.end(), from_, end);
    from_ = end;
  }

  std::string_view text_;
  const char* from_;
  ObjNotes& notes_;
  std::string material_;
  std::vector<std::uint8_t> mended_;
};

void applyTo(SourceTexture& texture, const std::map<std::string, MapOptions>& options, const char* keyword) {
  const auto found = options.find(keyword);
  if (found == options.end()) return;
  texture.transform = found->second.transform;
  if (found->second.clamp) texture.sampler.wrapU = texture.sampler.wrapV = WrapMode::Clamp;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> mendedMaterials(const std::vector<std::uint8_t>& file,
                                                         ObjNotes& notes) {
  return MaterialText({reinterpret_cast<const char*>(file.data()), file.size()}, notes).mended();
}

void apply(const ObjNotes& notes, SourceScene& scene) {
  for (SourceMaterial& material : scene.materials) {
    const auto options = notes.options.find(material.name);
    if (options == notes.options.end()) continue;
    applyTo(material.baseMap, options->second, "map_Kd");
    applyTo(material.emissiveMap, options->second, "map_Ke");
    applyTo(material.opacityMap, options->second, "map_d");
    applyTo(material.normalMap, options->second, "norm");
  }
  for (const ObjNotes::Missing& missing : notes.missing)
    scene.notes.push_back(
        {ContentUse::LeftOut, "the material library " + inQuotes(missing.file) + ": it " + missing.why});
  for (const std::string& option : notes.otherOptions)
    scene.notes.push_back({ContentUse::LeftOut, "map option " + option});
}

}  // namespace stadion::importer
