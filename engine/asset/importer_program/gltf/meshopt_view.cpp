#include "engine/asset/importer_program/gltf/meshopt_view.h"

#include <meshoptimizer.h>

namespace stadion::importer {
namespace {

/// The sizes that the decoders expect; they check none of them in release builds.
bool isStrideOf(const MeshoptView& view) {
  if (view.mode != "ATTRIBUTES") return view.stride == 2 || view.stride == 4;
  if (view.stride == 0 || view.stride % 4 != 0 || view.stride > 256) return false;
  if (view.filter == "OCTAHEDRAL") return view.stride == 4 || view.stride == 8;
  return view.filter != "QUATERNION" || view.stride == 8;
}

int decode(const MeshoptView& view, std::uint8_t* to) {
  const auto* bytes = view.bytes.data();
  const std::size_t size = view.bytes.size();
  if (view.mode == "ATTRIBUTES") return meshopt_decodeVertexBuffer(to, view.count, view.stride, bytes, size);
  if (view.mode == "TRIANGLES" && view.count % 3 == 0)
    return meshopt_decodeIndexBuffer(to, view.count, view.stride, bytes, size);
  if (view.mode == "INDICES") return meshopt_decodeIndexSequence(to, view.count, view.stride, bytes, size);
  return -1;
}

bool applyFilter(const MeshoptView& view, std::uint8_t* to) {
  if (view.filter.empty() || view.filter == "NONE" || view.mode != "ATTRIBUTES") return true;
  if (view.filter == "OCTAHEDRAL")
    meshopt_decodeFilterOct(to, view.count, view.stride);
  else if (view.filter == "QUATERNION")
    meshopt_decodeFilterQuat(to, view.count, view.stride);
  else if (view.filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(to, view.count, view.stride);
  else
    return false;
  return true;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> unpack(const MeshoptView& view, std::uint64_t mostBytes,
                                                std::string& why) {
  why = "its compression has an unknown mode, filter or stride";
  if (!isStrideOf(view)) return {};
  why = "it unpacks to more than a show's files may have";
  if (view.count > mostBytes / view.stride) return {};
  std::vector<std::uint8_t> to(view.count * view.stride);
  why = "its compressed data is damaged";
  if (decode(view, to.data()) != 0) return {};
  why = "its compression has an unknown filter";
  if (!applyFilter(view, to.data())) return {};
  return to;
}

}  // namespace stadion::importer
