#include "engine/asset/importer_program/gltf/gltf_document.h"

#include "engine/asset/importer_program/gltf/gltf_extensions.h"
#include "engine/asset/importer_program/gltf/meshopt_view.h"
#include "engine/asset/importer_program/gltf/uri.h"
#include "engine/asset/importer_program/source/model_files.h"
#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>
#include <cstring>

namespace stadion::importer {
namespace {

constexpr int kDeepestJson = 128;
constexpr std::uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

std::string_view textIn(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint32_t wordAt(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// Nested deeper, JSON would take much memory for few bytes.
bool isTooDeep(std::string_view json) {
  int depth = 0;
  bool inText = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inText && c == '\\')
      ++i;
    else if (c == '"')
      inText = !inText;
    else if (!inText && (c == '{' || c == '['))
      ++depth;
    else if (!inText && (c == '}' || c == ']'))
      --depth;
    if (depth > kDeepestJson) return true;
  }
  return false;
}

GltfJson parsed(std::span<const std::uint8_t> bytes) {
  std::string_view json = textIn(bytes);
  if (json.starts_with("\xef\xbb\xbf")) json.remove_prefix(3);
  if (isTooDeep(json)) throw Refusal("cannot be read as glTF 2.0: its JSON is nested too deep");
  try {
    return GltfJson::parse(json);
  } catch (const GltfJson::parse_error& error) {
    const std::string_view why = error.what();  // "[json.exception.parse_error.101] parse error at ..."
    throw Refusal("cannot be read as glTF 2.0: " + std::string(why.substr(why.find("] ") + 2)));
  }
}

/// The bytes of one component, 0 for a type that does not exist.
std::uint32_t componentBytes(std::uint64_t type) {
  switch (type) {
  case 5120:
  case 5121: return 1;
  case 5122:
  case 5123: return 2;
  case 5125:
  case 5126: return 4;
  default: return 0;
  }
}

std::uint32_t componentsOf(const std::string& type) {
  constexpr std::pair<std::string_view, std::uint32_t> kTypes[]{
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, count] : kTypes)
    if (type == name) return count;
  return 0;
}

template <class From, class To>
To convertedFrom(const std::uint8_t* at, bool normalized) {
  From value;
  std::memcpy(&value, at, sizeof value);
  if constexpr (std::is_same_v<To, float> && std::is_integral_v<From>)
    if (normalized)
      return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<From>::max()),
                      -1.0f);
  return static_cast<To>(value);
}

template <class To>
To componentAt(const std::uint8_t* at, std::uint64_t type, bool normalized) {
  switch (type) {
  case 5120: return convertedFrom<std::int8_t, To>(at, normalized);
  case 5121: return convertedFrom<std::uint8_t, To>(at, normalized);
  case 5122: return convertedFrom<std::int16_t, To>(at, normalized);
  case 5123: return convertedFrom<std::uint16_t, To>(at, normalized);
  case 5125: return convertedFrom<std::uint32_t, To>(at, normalized);
  default:
    if constexpr (std::is_same_v<To, float>) return convertedFrom<float, To>(at, normalized);
    return To{};
  }
}

}  // namespace

/// How an accessor's elements lie in their view.
struct GltfDocument::Layout {
  std::uint64_t type = 0, count = 0;
  std::uint32_t components = 0, bytes = 0;  ///< of an element
  bool normalized = false;

  /// Returns false if an element would lie outside the view.
  bool fits(const GltfView& view, std::uint64_t offset, std::uint64_t elements) const {
    const std::uint64_t stride = strideIn(view);
    if (elements == 0) return true;
    if (stride < bytes || offset > view.bytes.size()) return false;
    const std::uint64_t room = view.bytes.size() - offset;
    return room >= bytes && (room - bytes) / stride >= elements - 1;
  }
  std::uint64_t strideIn(const GltfView& view) const { return view.stride ? view.stride : bytes; }
};

GltfDocument::GltfDocument(const Request& request, const std::vector<std::uint8_t>& file)
    : request_(request), folder_(request.path.substr(0, request.path.rfind('/') + 1)) {
  readHead(file);
  refuseOldVersion();
  refuseUnknownExtensions();
  accessors_ = root().objects("accessors", "accessor");
  views_ = root().objects("bufferViews", "buffer view");
  buffers_ = root().objects("buffers", "buffer");
}

void GltfDocument::readHead(const std::vector<std::uint8_t>& file) {
  const bool binary = file.size() >= 4 && wordAt(file, 0) == kGlbMagic;
  json_ = parsed(binary ? readChunks(file) : std::span<const std::uint8_t>(file));
  if (!json_.is_object()) throw Refusal("cannot be read as glTF 2.0: its JSON is not an object");
}

// Returns the JSON, and keeps the chunk of binary data.
std::span<const std::uint8_t> GltfDocument::readChunks(std::span<const std::uint8_t> file) {
  const auto fail = [](const char* why) { throw Refusal(std::string("cannot be read as glTF 2.0: ") + why); };
  if (file.size() < 20) fail("its head is cut short");
  if (wordAt(file, 4) == 1) throw Refusal("is glTF 1.0; convert it to glTF 2.0");
  if (wordAt(file, 4) != 2) fail("its version is unknown");
  if (wordAt(file, 8) > file.size()) fail("it is cut short");
  std::span<const std::uint8_t> json,
      rest = file.first(wordAt(file, 8)).subspan(std::min<std::size_t>(12, wordAt(file, 8)));
  while (rest.size() >= 8) {
    const std::uint32_t size = wordAt(rest, 0), kind = wordAt(rest, 4);
    rest = rest.subspan(8);
    if (size > rest.size()) fail("a chunk is cut short");
    if (kind == kJsonChunk && json.empty()) json = rest.first(size);
    if (kind == kBinaryChunk && binaryChunk_.empty()) binaryChunk_ = rest.first(size);
    rest = rest.subspan(size);
  }
  if (json.empty()) fail("it holds no JSON");
  return json;
}

// Files of glTF 1.0 share the endings. Some state the version as a number.
void GltfDocument::refuseOldVersion() const {
  const GltfJson* asset = json_.contains("asset") ? &json_["asset"] : nullptr;
  if (!asset || !asset->is_object() || !asset->contains("version")) return;
  const GltfJson& version = (*asset)["version"];
  const bool old = version.is_string() ? version.get_ref<const std::string&>().starts_with("1")
                                       : version.is_number() && version.get<double>() < 2;
  if (old) throw Refusal("is glTF 1.0; convert it to glTF 2.0");
}

void GltfDocument::refuseUnknownExtensions() const {
  for (const std::string& name : root().texts("extensionsRequired"))
    if (!gltfExtension(name))
      throw Refusal("requires the glTF extension " + inQuotes(name) +
                    ", which shows do not read; export the model without it");
}

std::span<const std::uint8_t> GltfDocument::buffer(std::uint32_t index) {
  const GltfValue& value = buffers_[index];
  const std::uint64_t length = value.count("byteLength", 0);
  std::span<const std::uint8_t> bytes = binaryChunk_;
  if (value.has("uri") || index > 0 || binaryChunk_.empty()) {
    auto known = loaded_.find(index);
    if (known == loaded_.end()) {
      const std::string uri = value.text("uri");
      std::string why = "its data is not base64";
      auto read = isDataUri(uri) ? dataOf(uri)
                  : uri.empty()  ? std::optional(std::vector<std::uint8_t>())
                                 : readBeneath(request_.root.get(), folder_ + percentDecoded(uri),
                                               request_.head.fileBytes, &why);
      if (!read) value.refuse(isDataUri(uri) ? why : "the file " + inQuotes(percentDecoded(uri)) + " " + why);
      known = loaded_.emplace(index, std::move(*read)).first;
    }
    bytes = known->second;
  }
  if (bytes.size() < length)
    value.refuse("it has " + std::to_string(bytes.size()) + " bytes instead of " + std::to_string(length));
  return bytes.first(length);
}

// A view, or the compressed bytes that an extension describes likewise.
std::span<const std::uint8_t> GltfDocument::slice(const GltfValue& view) {
  const auto number = view.index("buffer", buffers_.size());
  if (!number) view.refuse("it names no buffer");
  const std::span<const std::uint8_t> bytes = buffer(*number);
  const std::uint64_t offset = view.count("byteOffset", 0), length = view.count("byteLength", 0);
  if (offset > bytes.size() || length > bytes.size() - offset) view.refuse("it reaches beyond its buffer");
  return bytes.subspan(offset, length);
}

GltfView GltfDocument::view(std::uint32_t index) {
  const GltfValue& value = views_[index];
  if (value.hasExtension("EXT_meshopt_compression"))
    return unpackMeshopt(value.extension("EXT_meshopt_compression"), index);
  return {slice(value), value.count("byteStride", 0)};
}

GltfView GltfDocument::unpackMeshopt(const GltfValue& view, std::uint32_t index) {
  const std::uint64_t stride = view.count("byteStride", 0);
  auto known = unpacked_.find(index);
  if (known == unpacked_.end()) {
    const MeshoptView packed{slice(view), view.count("count", 0), stride, view.text("mode"),
                             view.text("filter")};
    std::string why;
    auto bytes = unpack(packed, request_.head.fileBytes, why);
    if (!bytes) view.refuse(why);
    known = unpacked_.emplace(index, std::move(*bytes)).first;
  }
  return {known->second, stride};
}

GltfDocument::Layout GltfDocument::layoutOf(const GltfValue& accessor) const {
  Layout layout;
  layout.type = accessor.count("componentType", 0);
  layout.count = accessor.count("count", 0);
  layout.components = componentsOf(accessor.text("type"));
  layout.bytes = componentBytes(layout.type) * layout.components;
  layout.normalized = accessor.flag("normalized", false);
  if (layout.bytes == 0) accessor.refuse("its type is unknown");
  const std::uint64_t most = 3ull * std::max(request_.head.mesh.triangles, request_.head.mesh.vertices);
  if (layout.count > most) accessor.refuse("it has more than " + std::to_string(most) + " elements");
  return layout;
}

std::uint64_t GltfDocument::countOf(std::uint32_t accessor) const {
  return layoutOf(accessors_[accessor]).count;
}

std::uint32_t GltfDocument::componentsIn(std::uint32_t accessor) const {
  return layoutOf(accessors_[accessor]).components;
}

template <class To>
void GltfDocument::readDense(const GltfValue& accessor, const Layout& layout, std::vector<To>& to) {
  const auto number = accessor.index("bufferView", views_.size());
  if (!number) return;  // all zero
  const GltfView from = view(*number);
  const std::uint64_t offset = accessor.count("byteOffset", 0);
  if (!layout.fits(from, offset, layout.count)) accessor.refuse("it reaches beyond its buffer view");
  const std::uint32_t bytes = componentBytes(layout.type);
  for (std::uint64_t i = 0; i < layout.count; ++i)
    for (std::uint32_t k = 0; k < layout.components; ++k)
      to[i * layout.components + k] = componentAt<To>(
          from.bytes.data() + offset + i * layout.strideIn(from) + k * bytes, layout.type, layout.normalized);
}

template <class To>
void GltfDocument::readSparse(const GltfValue& accessor, const Layout& layout, std::vector<To>& to) {
  const GltfValue sparse = accessor.object("sparse");
  const std::uint64_t count = sparse.count("count", 0);
  if (count == 0) return;
  const GltfValue places = sparse.object("indices"), values = sparse.object("values");
  const auto placeView = places.index("bufferView", views_.size());
  const auto valueView = values.index("bufferView", views_.size());
  Layout place;
  place.type = places.count("componentType", 0);
  place.components = 1;
  place.bytes = componentBytes(place.type);
  const bool whole = place.type == 5121 || place.type == 5123 || place.type == 5125;
  if (!placeView || !valueView || !whole) accessor.refuse("its sparse part names no data");
  const GltfView fromPlaces = view(*placeView), fromValues = view(*valueView);
  const std::uint64_t placeOffset = places.count("byteOffset", 0),
                      valueOffset = values.count("byteOffset", 0);
  if (!place.fits(fromPlaces, placeOffset, count) || !layout.fits(fromValues, valueOffset, count))
    accessor.refuse("its sparse part reaches beyond its buffer view");
  const std::uint32_t bytes = componentBytes(layout.type);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto at = componentAt<std::uint32_t>(
        fromPlaces.bytes.data() + placeOffset + i * place.strideIn(fromPlaces), place.type, false);
    if (at >= layout.count) accessor.refuse("its sparse part names an element that does not exist");
    for (std::uint32_t k = 0; k < layout.components; ++k)
      to[std::size_t{at} * layout.components + k] =
          componentAt<To>(fromValues.bytes.data() + valueOffset + i * layout.strideIn(fromValues) + k * bytes,
                          layout.type, layout.normalized);
  }
}

template <class To>
std::vector<To> GltfDocument::read(std::uint32_t index, std::uint32_t& components) {
  const GltfValue& accessor = accessors_[index];
  const Layout layout = layoutOf(accessor);
  components = layout.components;
  std::vector<To> to(layout.count * layout.components);
  readDense(accessor, layout, to);
  readSparse(accessor, layout, to);
  return to;
}

GltfNumbers GltfDocument::numbers(std::uint32_t accessor) {
  GltfNumbers numbers;
  numbers.values = read<float>(accessor, numbers.components);
  return numbers;
}

std::vector<std::uint32_t> GltfDocument::indices(std::uint32_t accessor) {
  std::uint32_t components = 0;
  std::vector<std::uint32_t> corners = read<std::uint32_t>(accessor, components);
  if (components != 1) accessors_[accessor].refuse("it holds no single numbers");
  return corners;
}

}  // namespace stadion::importer
