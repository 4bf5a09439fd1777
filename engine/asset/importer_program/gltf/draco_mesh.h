#pragma once
/// Meshes that KHR_draco_mesh_compression has packed.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace stadion::importer {

/// An unpacked mesh.
class DracoMesh {
public:
  DracoMesh();
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  /// Returns false and the reason if the data is damaged, or makes more than so many points or triangles.
  bool unpack(std::span<const std::uint8_t> bytes, std::uint32_t mostPoints, std::uint32_t mostTriangles,
              std::string& why);

  std::size_t points() const;
  std::vector<std::array<std::uint32_t, 3>> triangles() const;
  /// The values of an attribute, `components` a point; empty if there is no such attribute. Integers become
  /// fractions if `normalized`.
  std::vector<float> values(std::uint32_t attribute, std::uint32_t components, bool normalized) const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace stadion::importer
