#include "engine/script/declaration_check.h"

#include <fmt/format.h>

namespace stadion {

std::vector<std::uint32_t> DeclarationCheck::places(Attr attr) const {
  std::vector<std::uint32_t> places;
  const AttributeSpec* spec = declaration_.type().find(attr);
  for (const RawAttribute& a : raw_.attributes)
    if (spec && declaration_.document().source().slice(a.name.offset, a.name.length) == spec->name)
      places.push_back(a.value.offset);
  return places;
}

void DeclarationCheck::error(Attr attr, std::string message) {
  const auto at = places(attr);
  report_.error(at.empty() ? raw_.type.offset : at.front(), std::move(message));
}

void checkVolume(DeclarationCheck& check, bool needed) {
  const bool sphere = check.stated("sphere"), box = check.stated("box");
  if (sphere != box || (!needed && !sphere)) return;
  check.error(fmt::format("{} needs {} \"sphere\" or \"box\"{}", check.declaration().type().name(),
                          sphere ? "either" : "a", sphere ? ", not both" : ""));
}

}  // namespace stadion
