#pragma once
/// The texts of a show's scripts, as they were when they were read: the show's own file and every sub-scene
/// below it.
///
///   const auto texts = ScriptTexts::read("scripts/olympia.evs", roots, types);
///   texts->show();                          // Result<SourceText>
///   texts->part("olympia/game_ball.evs");   // as a scene node names its file
///
/// A program that checks and then plays them plays what was checked, even if the files change meanwhile.
///
/// Errors   of a file that cannot be read are kept, and told when it is asked for.
/// Threads  constant once made.

#include "engine/script/source_text.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class AssetRoots;
class NodeRegistry;

class ScriptTexts {
public:
  static std::shared_ptr<const ScriptTexts> read(const std::string& script, const AssetRoots& roots,
                                                 const NodeRegistry& types);
  /// Reads a file that a scene node names, as it is on disk now. Errors say where it was looked for.
  static Result<SourceText> readPart(const std::string& name, const AssetRoots& roots);

  Result<SourceText> show() const { return show_; }
  /// A part that no script had named then is an error.
  Result<SourceText> part(const std::string& name) const;
  /// Returns the text of a part. If the text of a large one was left out, reads the file again, which must
  /// not have changed.
  Result<SourceText> part(const std::string& name, const AssetRoots& roots) const;
  /// Returns the texts without the show's own file, which is read once: a big one need not be kept.
  std::shared_ptr<const ScriptTexts> withoutShow() const;
  /// Returns the texts without the text of a part, if that is large.
  std::shared_ptr<const ScriptTexts> without(const std::string& name) const;
  /// The names of all parts.
  std::vector<std::string> parts() const;

private:
  explicit ScriptTexts(Result<SourceText> show) : show_(std::move(show)) {}

  struct Part {
    std::shared_ptr<const Result<SourceText>> text;  ///< shared by all that were made of one
    std::optional<std::uint64_t> leftOut{};          ///< the hash of its text, which is not here
  };

  Result<SourceText> show_;
  std::map<std::string, Part> parts_;
};

}  // namespace stadion
