#pragma once
/// One declaration, its values already checked one by one, for the rules that concern several of them
/// (NodeType::check).
///
/// Errors   a value that was wrong by itself is stated and has no value: has() is false.

#include "engine/script/document.h"
#include "engine/script/finding_collector.h"
#include "engine/script/syntax.h"

#include <string>
#include <vector>

namespace stadion {

class DeclarationCheck {
public:
  DeclarationCheck(const Declaration& declaration, const RawDeclaration& raw, FindingCollector& report)
      : declaration_(declaration), raw_(raw), report_(report) {}

  const Declaration& declaration() const { return declaration_; }
  /// The script names the attribute, be its value right or wrong.
  bool stated(Attr attr) const { return !places(attr).empty(); }
  /// Offsets of the attribute's values in the text.
  std::vector<std::uint32_t> places(Attr attr) const;

  void error(std::string message) { report_.error(raw_.type.offset, std::move(message)); }
  /// At the attribute's first value; at the type if it is not stated.
  void error(Attr attr, std::string message);
  void errorAt(std::uint32_t place, std::string message) { report_.error(place, std::move(message)); }

private:
  const Declaration& declaration_;
  const RawDeclaration& raw_;
  FindingCollector& report_;
};

/// "usertrigger needs a "sphere" or "box"": exactly one of the two, or none where the volume may be left out.
void checkVolume(DeclarationCheck& check, bool needed);

}  // namespace stadion
