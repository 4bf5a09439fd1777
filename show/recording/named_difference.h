#pragma once
/// Where two states differ by the names of their nodes and fields.
///
/// Two states whose scripts or models differ have different bytes. Their nodes and fields still have names.
/// The texts are those of StateFile::fields(): "@NODE<tab>FILE:LINE", and below it "FIELD<tab>VALUE" a line.
/// What is missing is zero. A text may begin with a list of all nodes: "@+NODE<tab>FILE:LINE" a line, without
/// fields.
///
/// Threads  plain functions, any thread.

#include <optional>
#include <string>

namespace stadion {

/// The first difference between two states: "ball (kick.evs:27), velocity", and both values.
struct SavedStateDifference {
  std::string where, here, there;
};

/// Begins the name of a node in the list of all nodes.
constexpr char kListedNode = '+';

/// The first name of which one state has more nodes, if both list them. Else the first field that differs, in
/// the order of `here`. Nodes without a name are taken by type and order: lines move when a script is edited.
std::optional<SavedStateDifference> namedDifference(const std::string& here, const std::string& there);

/// Returns the number of the frame whose state it is. Expects a text with fields.
std::string frameOf(const std::string& fields);

}  // namespace stadion
