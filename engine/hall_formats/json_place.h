#pragma once
/// A value in a JSON file with its place, which remembers what has been read of it: the rest is named to the
/// user by done().
///
/// Ownership  borrows the JSON value and the HallBuilder.
/// Threads    one file, one thread.
/// Errors     a value of another type than expected is an error with its place, such as /nodes/0/port.

#include "engine/hall_formats/hall_builder.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

class JsonPlace {
public:
  JsonPlace(const nlohmann::json& value, std::string path, HallBuilder& builder)
      : value_(&value), path_(std::move(path)), builder_(&builder) {}

  const std::string& path() const { return path_; }
  bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }

  /// Returns the object or array of that name; nothing if there is none.
  std::optional<JsonPlace> part(const std::string& key);
  /// Returns the elements of an array, or the members of an object with their names.
  std::vector<std::pair<std::string, JsonPlace>> parts() const;
  /// Returns the values of members; `otherwise` if there is none.
  double number(const std::string& key, double otherwise);
  std::string text(const std::string& key, const std::string& otherwise = {});
  bool flag(const std::string& key, bool otherwise);

  /// Names members that say nothing about a hall.
  void ignore(std::initializer_list<const char*> keys);
  /// Warns of each member that was neither read nor ignored.
  void done();
  /// Reports an error at this place.
  void refuse(const std::string& why) const;
  void warn(const std::string& what) const;
  void note(const std::string& what) const;

private:
  const nlohmann::json* find(const std::string& key);

  const nlohmann::json* value_;
  std::string path_;
  HallBuilder* builder_;
  std::set<std::string> read_;
};

/// Parses JSON, with comments. Nothing and an error with line and column if it is not sound.
std::optional<nlohmann::json> parseJson(const std::string& text, HallBuilder& builder);

}  // namespace stadion
