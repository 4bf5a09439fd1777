#include "engine/asset/importer_program/gltf/gltf_reader.h"

#include "engine/asset/importer_program/gltf/gltf_extensions.h"
#include "engine/asset/importer_program/gltf/gltf_parts.h"
#include "engine/asset/importer_program/source/name_list.h"
#include "engine/asset/importer_program/source/up_axis.h"

namespace stadion::importer {
namespace {

/// Names the extensions that are more than what the source scene holds of them.
void noteExtensions(const GltfDocument& document, SourceScene& to) {
  for (const std::string& name : document.root().texts("extensionsUsed")) {
    const auto known = gltfExtension(name);
    if (!known)
      to.notes.push_back({ContentUse::LeftOut, "unknown glTF extension " + inQuotes(name)});
    else if (known->named)
      to.notes.push_back({known->use, "glTF extension " + inQuotes(name)});
  }
}

}  // namespace

SourceScene readGltf(const Request& request, const std::vector<std::uint8_t>& file) {
  GltfDocument document(request, file);
  SourceScene to;
  to.linearColours = true;
  const UpAxis up = request.head.up ? static_cast<UpAxis>(request.head.up - 1) : UpAxis::Y;
  to.toShow.linear() = (request.head.unit > 0 ? request.head.unit : 1.0) * toZUp(up);
  readGltfMaterials(document, to);
  readGltfMeshes(document, to);
  readGltfNodes(document, to);
  readGltfMotion(document, to);
  noteExtensions(document, to);
  return to;
}

}  // namespace stadion::importer
