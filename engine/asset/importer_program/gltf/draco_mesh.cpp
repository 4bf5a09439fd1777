#include "engine/asset/importer_program/gltf/draco_mesh.h"

#include <draco/compression/decode.h>

#include <limits>

namespace stadion::importer {
namespace {

/// What a normalized integer is divided by; 1 for floats.
float divisorOf(draco::DataType type) {
  switch (type) {
  case draco::DT_INT8: return std::numeric_limits<std::int8_t>::max();
  case draco::DT_UINT8: return std::numeric_limits<std::uint8_t>::max();
  case draco::DT_INT16: return std::numeric_limits<std::int16_t>::max();
  case draco::DT_UINT16: return std::numeric_limits<std::uint16_t>::max();
  default: return 1;
  }
}

bool isWithin(const draco::Mesh& mesh, std::uint32_t mostPoints, std::uint32_t mostTriangles) {
  return mesh.num_points() <= mostPoints && mesh.num_faces() <= mostTriangles;
}

}  // namespace

struct DracoMesh::Content {
  std::unique_ptr<draco::Mesh> mesh;
};

DracoMesh::DracoMesh() : content_(std::make_unique<Content>()) {}
DracoMesh::~DracoMesh() = default;

bool DracoMesh::unpack(std::span<const std::uint8_t> bytes, std::uint32_t mostPoints,
                       std::uint32_t mostTriangles, std::string& why) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  why = "its compressed data is damaged";
  if (!decoded.ok()) return false;
  content_->mesh = std::move(decoded).value();
  why = "it unpacks to more vertices or triangles than a model may have";
  return isWithin(*content_->mesh, mostPoints, mostTriangles);
}

std::size_t DracoMesh::points() const {
  return content_->mesh->num_points();
}

std::vector<std::array<std::uint32_t, 3>> DracoMesh::triangles() const {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(content_->mesh->num_faces());
  for (draco::FaceIndex f(0); f < content_->mesh->num_faces(); ++f) {
    const auto& face = content_->mesh->face(f);
    triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return triangles;
}

std::vector<float> DracoMesh::values(std::uint32_t attribute, std::uint32_t components,
                                     bool normalized) const {
  const draco::PointAttribute* from = content_->mesh->GetAttributeByUniqueId(attribute);
  if (!from || components == 0 || components > 4) return {};
  const float divisor = normalized && !from->normalized() ? divisorOf(from->data_type()) : 1;
  std::vector<float> values(points() * components);
  for (draco::PointIndex i(0); i < content_->mesh->num_points(); ++i) {
    std::array<float, 4> value{};
    const draco::AttributeValueIndex at = from->mapped_index(i);
    if (at.value() >= from->size() ||
        !from->ConvertValue<float>(at, static_cast<std::int8_t>(components), value.data()))
      return {};
    for (std::uint32_t k = 0; k < components; ++k)
      values[std::size_t{i.value()} * components + k] = value[k] / divisor;
  }
  return values;
}

}  // namespace stadion::importer
