#include "engine/hall_formats/json_place.h"

#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kMostJsonNumber = 1e7;

SourcePosition placeInText(const std::string& file, const std::string& text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  const auto lines = std::count(text.begin(), end, '\n');
  return {file, static_cast<std::uint32_t>(lines + 1), 0};
}

}  // namespace

const nlohmann::json* JsonPlace::find(const std::string& key) {
  if (!value_->is_object()) return nullptr;
  const auto at = value_->find(key);
  if (at == value_->end()) return nullptr;
  read_.insert(key);
  return &*at;
}

std::optional<JsonPlace> JsonPlace::part(const std::string& key) {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  JsonPlace place(*value, path_ + "/" + printable(key, 60), *builder_);
  if (value->is_structured()) return place;
  place.refuse("must be an object or a list");
  return std::nullopt;
}

std::vector<std::pair<std::string, JsonPlace>> JsonPlace::parts() const {
  std::vector<std::pair<std::string, JsonPlace>> all;
  std::size_t number = 0;
  if (value_->is_array())
    for (const auto& item : *value_) {
      const std::string name = std::to_string(number++);
      all.emplace_back(name, JsonPlace(item, path_ + "/" + name, *builder_));
    }
  if (value_->is_object())
    for (const auto& [key, item] : value_->items())
      all.emplace_back(key, JsonPlace(item, path_ + "/" + printable(key, 60), *builder_));
  return all;
}

double JsonPlace::number(const std::string& key, double otherwise) {
  const nlohmann::json* value = find(key);
  if (!value) return otherwise;
  const double number = value->is_number() ? value->get<double>() : std::nan("");
  if (std::fabs(number) <= kMostJsonNumber) return number;
  JsonPlace(*value, path_ + "/" + printable(key, 60), *builder_).refuse("must be a number of at most 1e7");
  return otherwise;
}

std::string JsonPlace::text(const std::string& key, const std::string& otherwise) {
  const nlohmann::json* value = find(key);
  if (!value) return otherwise;
  if (value->is_string()) return value->get<std::string>();
  JsonPlace(*value, path_ + "/" + printable(key, 60), *builder_).refuse("must be a text");
  return otherwise;
}

bool JsonPlace::flag(const std::string& key, bool otherwise) {
  const nlohmann::json* value = find(key);
  if (!value) return otherwise;
  if (value->is_boolean()) return value->get<bool>();
  JsonPlace(*value, path_ + "/" + printable(key, 60), *builder_).refuse("must be true or false");
  return otherwise;
}

void JsonPlace::ignore(std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (find(key)) builder_->notOfHall(key);
}

void JsonPlace::done() {
  if (!value_->is_object()) return;
  for (const auto& [key, item] : value_->items())
    if (!read_.contains(key))
      builder_->notUnderstood({builder_->file(), 0, 0}, path_ + "/" + printable(key, 60), "it has no effect");
}

void JsonPlace::refuse(const std::string& why) const {
  builder_->error(fmt::format("{}: {}", path_.empty() ? "/" : path_, why));
}

void JsonPlace::warn(const std::string& what) const {
  builder_->warning(fmt::format("{}: {}", path_, what));
}

void JsonPlace::note(const std::string& what) const {
  builder_->note(fmt::format("{}: {}", path_, what));
}

std::optional<nlohmann::json> parseJson(const std::string& text, HallBuilder& builder) {
  try {
    return nlohmann::json::parse(text, nullptr, true, true);
  } catch (const nlohmann::json::parse_error& fault) {
    builder.out().error(placeInText(builder.file(), text, fault.byte),
                        "this is not sound JSON: " + printable(fault.what(), 200));
  } catch (const nlohmann::json::exception& fault) {  // such as a number out of range
    builder.out().error({builder.file(), 0, 0}, "this is not sound JSON: " + printable(fault.what(), 200));
  }
  return std::nullopt;
}

}  // namespace stadion
