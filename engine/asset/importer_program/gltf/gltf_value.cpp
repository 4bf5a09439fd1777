#include "engine/asset/importer_program/gltf/gltf_value.h"

#include "engine/asset/importer_program/source/name_list.h"

#include <cmath>

namespace stadion::importer {
namespace {

const GltfJson& emptyObject() {
  static const GltfJson empty = GltfJson::object();
  return empty;
}

}  // namespace

GltfValue::GltfValue(const GltfJson& json, std::string place) : json_(&json), place_(std::move(place)) {
  if (!json.is_object()) refuse("it is not an object");
}

void GltfValue::refuse(const std::string& why) const {
  throw Refusal("is wrong" + (place_.empty() ? "" : " in " + place_) + ": " + why);
}

const GltfJson* GltfValue::find(const char* key) const {
  const auto at = json_->find(key);
  return at == json_->end() ? nullptr : &*at;
}

GltfValue GltfValue::object(const char* key) const {
  const GltfJson* value = find(key);
  if (value && !value->is_object()) refuse(std::string("\"") + key + "\" is not an object");
  return {value ? *value : emptyObject(), place_};
}

std::vector<GltfValue> GltfValue::objects(const char* key, const char* what) const {
  std::vector<GltfValue> list;
  const GltfJson* value = find(key);
  if (!value) return list;
  if (!value->is_array()) refuse(std::string("\"") + key + "\" is not a list");
  for (const GltfJson& item : *value) {
    std::string place = (place_.empty() ? "" : place_ + ", ") + what + " " + std::to_string(list.size());
    if (item.is_object() && item.contains("name") && item["name"].is_string())
      place += " (" + inQuotes(item["name"].get_ref<const std::string&>()) + ")";
    list.emplace_back(item, std::move(place));
  }
  return list;
}

bool GltfValue::hasExtension(const char* name) const {
  return object("extensions").has(name);
}

GltfValue GltfValue::extension(const char* name) const {
  return object("extensions").object(name);
}

std::vector<std::string> GltfValue::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json_->items()) keys.push_back(key);
  return keys;
}

double GltfValue::number(const char* key, double fallback) const {
  const GltfJson* value = find(key);
  if (!value) return fallback;
  if (!value->is_number()) refuse(std::string("\"") + key + "\" is not a number");
  return value->get<double>();
}

float GltfValue::real(const char* key, float fallback) const {
  const auto value = static_cast<float>(number(key, double{fallback}));
  return std::isfinite(value) ? value : fallback;
}

bool GltfValue::flag(const char* key, bool fallback) const {
  const GltfJson* value = find(key);
  if (!value) return fallback;
  if (!value->is_boolean()) refuse(std::string("\"") + key + "\" is neither true nor false");
  return value->get<bool>();
}

std::string GltfValue::text(const char* key) const {
  const GltfJson* value = find(key);
  if (!value) return {};
  if (!value->is_string()) refuse(std::string("\"") + key + "\" is not a text");
  return value->get<std::string>();
}

std::vector<std::string> GltfValue::texts(const char* key) const {
  std::vector<std::string> list;
  const GltfJson* value = find(key);
  if (value && !value->is_array()) refuse(std::string("\"") + key + "\" is not a list");
  if (!value) return list;
  for (const GltfJson& item : *value)
    if (item.is_string()) list.push_back(item.get<std::string>());
  return list;
}

std::uint64_t GltfValue::wholeNumber(const GltfJson& value, const char* key) const {
  constexpr double kMost = 9007199254740992.0;  // doubles are exact up to here
  const double number = value.is_number() ? value.get<double>() : -1;
  if (!(number >= 0 && number <= kMost) || number != std::floor(number))
    refuse(std::string("\"") + key + "\" is not a whole number");
  return static_cast<std::uint64_t>(number);
}

std::uint64_t GltfValue::count(const char* key, std::uint64_t fallback) const {
  const GltfJson* value = find(key);
  return value ? wholeNumber(*value, key) : fallback;
}

std::uint32_t GltfValue::checkedIndex(const GltfJson& value, const char* key, std::size_t size) const {
  const std::uint64_t index = wholeNumber(value, key);
  if (index >= size)
    refuse(std::string("\"") + key + "\" names number " + std::to_string(index) + ", but there are " +
           std::to_string(size));
  return static_cast<std::uint32_t>(index);
}

std::optional<std::uint32_t> GltfValue::index(const char* key, std::size_t size) const {
  const GltfJson* value = find(key);
  return value ? std::optional(checkedIndex(*value, key, size)) : std::nullopt;
}

std::vector<std::uint32_t> GltfValue::indices(const char* key, std::size_t size) const {
  std::vector<std::uint32_t> list;
  const GltfJson* value = find(key);
  if (value && !value->is_array()) refuse(std::string("\"") + key + "\" is not a list");
  if (!value) return list;
  for (const GltfJson& item : *value) list.push_back(checkedIndex(item, key, size));
  return list;
}

std::vector<double> GltfValue::numbers(const char* key) const {
  std::vector<double> list;
  const GltfJson* value = find(key);
  if (value && !value->is_array()) refuse(std::string("\"") + key + "\" is not a list");
  if (!value) return list;
  for (const GltfJson& item : *value) {
    if (!item.is_number()) refuse(std::string("\"") + key + "\" holds what is not a number");
    list.push_back(item.get<double>());
  }
  return list;
}

void GltfValue::readReals(const char* key, std::span<float> to) const {
  if (!find(key)) return;
  const std::vector<double> list = numbers(key);
  if (list.size() != to.size())
    refuse(std::string("\"") + key + "\" has " + std::to_string(list.size()) + " numbers instead of " +
           std::to_string(to.size()));
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] = static_cast<float>(list[i]);
    if (!std::isfinite(to[i])) refuse(std::string("\"") + key + "\" holds a number that is too large");
  }
}

}  // namespace stadion::importer
