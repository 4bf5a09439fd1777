#pragma once
/// Where two states differ by the names of their nodes and fields.
///
/// Two states whose scripts or models differ have different bytes. Their nodes and fields still have names.
/// The texts are those of fieldsIn(): "@NODE<tab>FILE:LINE", and below it "FIELD<tab>VALUE" a line. What is
/// missing is zero.
///
/// Threads  plain functions, any thread.

#include <optional>
#include <string>

namespace stadion {

/// The first difference between two states: "ball (kick.evs:27), velocity", and both values.
struct SavedStateDifference {
  std::string where, here, there;
};

/// The first field that differs, in the order of `here`. Nodes without a name are taken by type and order:
/// lines move when a script is edited.
std::optional<SavedStateDifference> namedDifference(const std::string& here, const std::string& there);

/// Returns the number of the frame whose state it is. Expects a text with fields.
std::string frameOf(const std::string& fields);

}  // namespace stadion
