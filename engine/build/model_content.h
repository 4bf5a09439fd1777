#pragma once
/// Finds what a model's file holds beside triangles, for nodes that refer to it by name.

#include "engine/build/node_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

inline Vec3 vectorOf(const std::array<float, 3>& v) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}

/// The first names of a list, in quotation marks.
template <class Things>
std::string namesOf(const Things& things) {
  constexpr std::size_t kMost = 20;
  std::string names;
  for (std::size_t i = 0; i < std::min(things.size(), kMost); ++i)
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", things[i].name);
  return things.size() > kMost ? fmt::format("{} and {} more", names, things.size() - kMost) : names;
}

/// The model that the reference `owner` names, of which `attribute` wants something. Nothing if there is none: then
/// the findings say so, unless its file could not be loaded.
inline std::optional<PlacedModel> modelFor(const NodeRequest& r, std::string_view attribute,
                                           std::string_view owner) {
  const Declaration& d = r.declaration;
  const auto named = d.reference(Attr::of(owner));
  std::optional<PlacedModel> model = named ? r.model(*named) : std::nullopt;
  if (!model)
    r.findings.error(
        d.where(Attr::of(attribute)),
        fmt::format("{} needs {}=NAME, the name of an object in the same file", attribute, owner),
        d.excerpt(Attr::of(attribute)));
  return model && !model->mesh->standIn ? model : std::nullopt;
}

/// What of a model has the name that the attribute states, such as one of its lights. Null if there is none: then
/// the findings say so. `what` names such a thing.
template <class Thing>
const Thing* findIn(const std::vector<Thing>& all, const NodeRequest& r, std::string_view attribute,
                    std::string_view what) {
  const Declaration& d = r.declaration;
  const auto at = std::ranges::find(all, d.text(Attr::of(attribute)), &Thing::name);
  if (at != all.end()) return &*at;
  const std::string have = all.empty() ? fmt::format("; it has no {}s", what) : "; there are " + namesOf(all);
  r.findings.error(d.where(Attr::of(attribute)),
                   fmt::format("the model has no {} \"{}\"{}", what, d.text(Attr::of(attribute)), have),
                   d.excerpt(Attr::of(attribute)));
  return nullptr;
}

}  // namespace stadion
