#pragma once
/// A glTF file's JSON and its binary data.

#include "engine/asset/importer_program/gltf/gltf_value.h"
#include "engine/asset/importer_program/source/channel.h"

#include <map>

namespace stadion::importer {

/// Bytes of a buffer view.
struct GltfView {
  std::span<const std::uint8_t> bytes;
  std::uint64_t stride = 0;  ///< [bytes] 0: elements lie next to each other
};

/// Numbers of an accessor, as many components an element as its type has.
struct GltfNumbers {
  std::uint32_t components = 0;
  std::vector<float> values;  ///< (count x components)

  std::size_t count() const { return components ? values.size() / components : 0; }
  template <std::size_t N>
  std::array<float, N> element(std::size_t i) const {
    std::array<float, N> e{};
    for (std::size_t k = 0; k < N && k < components; ++k) e[k] = values[i * components + k];
    return e;
  }
};

/// The content of a .gltf or .glb file, and of the buffers that it names.
///
/// Errors   All offsets, strides and counts are checked. Refusal names the accessor, view or buffer.
class GltfDocument {
public:
  /// Reads the JSON alone; buffers are read when they are needed. Expects that `file` and `request` outlive
  /// the document. Refuses files that require an extension which is not known.
  GltfDocument(const Request& request, const std::vector<std::uint8_t>& file);

  GltfValue root() const { return {json_, {}}; }
  const std::vector<GltfValue>& accessors() const { return accessors_; }

  GltfView view(std::uint32_t index);
  std::size_t viewCount() const { return views_.size(); }
  /// Numbers as floats; normalized integers become fractions. Expects an index within accessors().
  GltfNumbers numbers(std::uint32_t accessor);
  /// Whole numbers, for the corners of triangles.
  std::vector<std::uint32_t> indices(std::uint32_t accessor);
  /// How many elements an accessor has.
  std::uint64_t countOf(std::uint32_t accessor) const;
  /// How many components an element of an accessor has.
  std::uint32_t componentsIn(std::uint32_t accessor) const;

  const Request& request() const { return request_; }
  /// The model's folder below the asset root, "" or ending in '/'.
  const std::string& folder() const { return folder_; }

private:
  struct Layout;
  void readHead(const std::vector<std::uint8_t>& file);
  std::span<const std::uint8_t> readChunks(std::span<const std::uint8_t> file);
  void refuseOldVersion() const;
  void refuseUnknownExtensions() const;
  std::span<const std::uint8_t> buffer(std::uint32_t index);
  std::span<const std::uint8_t> slice(const GltfValue& view);
  GltfView unpackMeshopt(const GltfValue& view, std::uint32_t index);
  Layout layoutOf(const GltfValue& accessor) const;
  template <class To>
  std::vector<To> read(std::uint32_t accessor, std::uint32_t& components);
  template <class To>
  void readDense(const GltfValue& accessor, const Layout& layout, std::vector<To>& to);
  template <class To>
  void readSparse(const GltfValue& accessor, const Layout& layout, std::vector<To>& to);

  const Request& request_;
  std::string folder_;
  GltfJson json_;
  std::span<const std::uint8_t> binaryChunk_;
  std::vector<GltfValue> accessors_, views_, buffers_;
  std::map<std::uint32_t, std::vector<std::uint8_t>> loaded_;    ///< buffers by index
  std::map<std::uint32_t, std::vector<std::uint8_t>> unpacked_;  ///< views by index
};

}  // namespace stadion::importer
