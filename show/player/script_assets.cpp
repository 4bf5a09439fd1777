#include "show/player/script_assets.h"

#include "engine/base/plain_file.h"
#include "engine/script/script.h"
#include "engine/script/script_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <optional>
#include <set>

namespace stadion {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostAssetBytes = std::size_t{512} << 20;

std::string contentOf(const fs::path& file) {
  const Result<std::string> text = readPlainFile(file.string(), kMostAssetBytes);
  return text ? text.value() : std::string();
}

/// What a file of models in this folder would call the other one; nothing if it lies elsewhere, where models
/// find nothing.
std::optional<std::string> nameFrom(const fs::path& folder, const fs::path& file) {
  std::error_code none;
  const fs::path name =
      fs::weakly_canonical(file, none).lexically_relative(fs::weakly_canonical(folder, none));
  if (name.empty() || *name.begin() == "..") return std::nullopt;
  return name.generic_string();
}

/// Whether the name stands in the content by itself, not within a longer one.
bool names(const std::string& content, const std::string& name) {
  const auto goesOn = [&](std::size_t at) {
    if (at >= content.size()) return false;
    const unsigned char c = static_cast<unsigned char>(content[at]);
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  };
  for (std::size_t at = content.find(name); at != content.npos; at = content.find(name, at + 1))
    if ((at == 0 || !goesOn(at - 1)) && !goesOn(at + name.size())) return true;
  return false;
}

/// As glTF writes names: "a%20b.png" is "a b.png".
std::string withoutPercents(const std::string& content) {
  std::string plain;
  for (std::size_t i = 0; i < content.size(); ++i) {
    unsigned char byte = 0;
    const char* const hex = content.data() + i + 1;
    const bool coded =
        content[i] == '%' && i + 2 < content.size() && std::from_chars(hex, hex + 2, byte, 16).ptr == hex + 2;
    plain += coded ? static_cast<char>(byte) : content[i];
    i += coded ? 2 : 0;
  }
  return plain;
}

/// A model's content, and that of the materials beside it, which name pictures.
std::string withMaterials(const fs::path& model) {
  std::string content = contentOf(model);
  std::error_code none;
  const fs::path folder = model.has_parent_path() ? model.parent_path() : fs::path(".");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".mtl" && names(content, entry.path().filename().string()))
      content += '\n' + contentOf(entry.path());
  if (content.find('%') != std::string::npos) content += '\n' + withoutPercents(content);
  return content;
}

class Assets {
public:
  Assets(const AssetRoots& roots, const NodeRegistry& types, std::span<const std::string> suspects,
         std::vector<NamedFile>& files)
      : roots_(roots), types_(types), suspects_(suspects), files_(files) {}

  void addAllOf(const Result<SourceText>& source) {
    if (!source) return;
    Diagnostics ignored;
    const Document document = parseScript(SourceText(source.value()), types_, ignored);
    for (const Declaration d : document)
      for (const AttributeSpec& row : d.type().attributes())
        if (row.kind == ValueKind::File && d.has(row.attr)) add(d, row.attr);
  }

private:
  void add(const Declaration& d, Attr attr) {
    const std::string name(d.text(attr));
    if (name.empty() || !seen_.insert(name).second) return;
    const auto found = roots_.open(name);
    if (!found) return;
    const SourcePosition at = d.where(attr);
    files_.push_back({fmt::format("{}:{}:{}", at.file, at.line, at.column), found.value().path, false});
    if (!d.is(Trait::Encloses) && !d.is(Trait::Sound) && !d.is(Trait::Surroundings))
      addNamedBy(found.value().path);
  }

  void addNamedBy(const std::string& model) {
    const fs::path folder = fs::path(model).parent_path();
    std::optional<std::string> content;  // read only for files that it could name
    for (const std::string& suspect : suspects_) {
      const auto name = nameFrom(folder.empty() ? "." : folder, suspect);
      if (!name) continue;
      if (!content) content = withMaterials(model);
      if (names(*content, *name)) files_.push_back({model, suspect, false});
    }
  }

  const AssetRoots& roots_;
  const NodeRegistry& types_;
  std::span<const std::string> suspects_;
  std::vector<NamedFile>& files_;
  std::set<std::string> seen_;
};

}  // namespace

void addAssetsOf(const std::string& script, const AssetRoots& roots, const NodeRegistry& types,
                 std::span<const std::string> suspects, std::vector<NamedFile>& files) {
  const auto texts = ScriptTexts::read(script, roots, types);
  Assets assets(roots, types, suspects, files);
  assets.addAllOf(texts->show());
  for (const std::string& part : texts->parts()) assets.addAllOf(texts->part(part));
}

}  // namespace stadion
