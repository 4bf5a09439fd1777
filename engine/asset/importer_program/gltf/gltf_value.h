#pragma once
/// An object of a glTF file's JSON, with checks of types and indices.

#include "engine/asset/importer_program/source/source_scene.h"

#include <nlohmann/json.hpp>

#include <span>

namespace stadion::importer {

using GltfJson = nlohmann::json;

/// A JSON object and its place in the file.
///
/// Errors   Each function throws Refusal if a value has the wrong type: `is wrong in mesh 3 ("roof"): ...`.
///          A value that is missing gives the fallback, or an empty object or list.
class GltfValue {
public:
  GltfValue(const GltfJson& json, std::string place);

  bool has(const char* key) const { return json_->contains(key); }
  GltfValue object(const char* key) const;
  /// The objects in a list; each is placed as `what 3 ("its name")`.
  std::vector<GltfValue> objects(const char* key, const char* what) const;
  /// The extension of this name, an empty object if there is none.
  GltfValue extension(const char* name) const;
  bool hasExtension(const char* name) const;
  std::vector<std::string> keys() const;

  double number(const char* key, double fallback) const;
  float real(const char* key, float fallback) const;
  bool flag(const char* key, bool fallback) const;
  std::string text(const char* key) const;
  std::vector<std::string> texts(const char* key) const;
  /// A whole number, at most 2^53.
  std::uint64_t count(const char* key, std::uint64_t fallback) const;
  /// An index into a list of `size` things; nothing if it is missing.
  std::optional<std::uint32_t> index(const char* key, std::size_t size) const;
  std::vector<std::uint32_t> indices(const char* key, std::size_t size) const;
  /// Exactly N finite numbers.
  template <std::size_t N>
  std::array<float, N> reals(const char* key, std::array<float, N> fallback) const {
    readReals(key, fallback);
    return fallback;
  }
  /// Numbers of a list of any length.
  std::vector<double> numbers(const char* key) const;

  const std::string& place() const { return place_; }
  [[noreturn]] void refuse(const std::string& why) const;

private:
  const GltfJson* find(const char* key) const;
  std::uint64_t wholeNumber(const GltfJson& value, const char* key) const;
  std::uint32_t checkedIndex(const GltfJson& value, const char* key, std::size_t size) const;
  void readReals(const char* key, std::span<float> to) const;

  const GltfJson* json_;
  std::string place_;
};

}  // namespace stadion::importer
