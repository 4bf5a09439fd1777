#pragma once
/// What differs between two draw lists, to the bit.
///
/// Threads  any; both lists are whole and no thread changes them.

#include "pipeline/draw_list/draw_list.h"

#include <optional>
#include <string_view>

namespace stadion {

struct ListDifference {
  std::string_view field;  ///< as in the list and its items
  NodeRef node;            ///< invalid: of no node
};

/// The first difference; nothing: they are equal. Neither tickets nor fillings are compared.
std::optional<ListDifference> differenceOf(const DrawList& a, const DrawList& b);

}  // namespace stadion
