#include "engine/asset/format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

namespace stadion {
namespace {

constexpr std::array kFormats{
    FormatInfo{ModelFormat::Obj, "obj", "OBJ", "Wavefront Object Importer", UpAxis::Y, 1.0, false, false},
    FormatInfo{ModelFormat::ThreeDs, "3ds", "3DS", "Discreet 3DS Importer", UpAxis::Z, 1.0, false, false},
    FormatInfo{ModelFormat::Gltf, "gltf", "glTF 2.0", "", UpAxis::Y, 1.0, false, true},
    FormatInfo{ModelFormat::Gltf, "glb", "glTF 2.0", "", UpAxis::Y, 1.0, false, true},
    FormatInfo{ModelFormat::Collada, "dae", "COLLADA", "Collada Importer", UpAxis::Y, 1.0, true, false},
    FormatInfo{ModelFormat::Fbx, "fbx", "FBX", "Autodesk FBX Importer", UpAxis::Y, 0.01, true, false},
    FormatInfo{ModelFormat::Ply, "ply", "PLY", "Stanford Polygon Library (PLY) Importer", UpAxis::Z, 1.0,
               false, false},
    FormatInfo{ModelFormat::Stl, "stl", "STL", "Stereolithography (STL) Importer", UpAxis::Z, 1.0, false,
               false},
};

struct RefusedFormat {
  const char* extension;
  const char* name;
};

// Formats with loaders that crash on hostile files, or that shows do not need.
constexpr RefusedFormat kRefused[] = {
    {"3d", "Unreal"},
    {"3mf", "3MF"},
    {"ac", "AC3D"},
    {"ac3d", "AC3D"},
    {"acc", "AC3D"},
    {"amf", "AMF"},
    {"ase", "ASE"},
    {"ask", "ASE"},
    {"assbin", "ASSBIN"},
    {"b3d", "Blitz3D"},
    {"blend", "Blender"},
    {"bsp", "Quake BSP"},
    {"bvh", "BVH"},
    {"cob", "TrueSpace"},
    {"scn", "TrueSpace"},
    {"csm", "CSM"},
    {"dxf", "DXF"},
    {"hmp", "HMP"},
    {"ifc", "IFC"},
    {"iqm", "IQM"},
    {"irr", "Irrlicht"},
    {"irrmesh", "Irrlicht"},
    {"jt", "JT"},
    {"lwo", "LightWave"},
    {"lws", "LightWave"},
    {"lxo", "Modo"},
    {"m3d", "Model 3D"},
    {"a3d", "Model 3D"},
    {"max", "3ds Max"},
    {"md2", "Quake MD2"},
    {"md3", "Quake MD3"},
    {"md5mesh", "Doom MD5"},
    {"mdc", "MDC"},
    {"mdl", "MDL"},
    {"mesh", "Ogre"},
    {"mot", "LightWave"},
    {"ms3d", "MilkShape"},
    {"ndo", "Nendo"},
    {"nff", "NFF"},
    {"enff", "NFF"},
    {"off", "OFF"},
    {"ogex", "OpenGEX"},
    {"pk3", "Quake BSP"},
    {"pmx", "MMD"},
    {"prj", "3DS project"},
    {"q3o", "Quick3D"},
    {"q3s", "Quick3D"},
    {"raw", "RAW"},
    {"sib", "Silo"},
    {"smd", "SMD"},
    {"stp", "STEP"},
    {"step", "STEP"},
    {"ter", "Terragen"},
    {"uc", "Unreal"},
    {"usd", "USD"},
    {"usdz", "USD"},
    {"vta", "SMD"},
    {"wrl", "VRML"},
    {"x", "DirectX"},
    {"x3d", "X3D"},
    {"x3db", "X3D"},
    {"xgl", "XGL"},
    {"zae", "zipped COLLADA"},
    {"zgl", "XGL"},
};

std::string extensionOf(std::string_view fileName) {
  const auto slash = fileName.rfind('/');
  if (slash != std::string_view::npos) fileName.remove_prefix(slash + 1);
  const auto dot = fileName.rfind('.');
  if (dot == std::string_view::npos) return {};
  std::string extension(fileName.substr(dot + 1));
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

const FormatInfo* formatOf(std::string_view fileName) {
  const std::string extension = extensionOf(fileName);
  const auto at = std::find_if(kFormats.begin(), kFormats.end(),
                               [&](const FormatInfo& f) { return extension == f.extension; });
  return at == kFormats.end() ? nullptr : &*at;
}

std::optional<RadianceFormat> radianceFormatOf(std::string_view fileName) {
  const std::string extension = extensionOf(fileName);
  if (extension == "hdr") return RadianceFormat::Hdr;
  if (extension == "exr") return RadianceFormat::Exr;
  return std::nullopt;
}

std::string radianceFormats() {
  return "Radiance HDR (.hdr) and OpenEXR (.exr)";
}

std::optional<std::string> refusedFormat(std::string_view fileName) {
  const std::string extension = extensionOf(fileName);
  const auto at = std::find_if(std::begin(kRefused), std::end(kRefused),
                               [&](const RefusedFormat& r) { return extension == r.extension; });
  if (at == std::end(kRefused)) return std::nullopt;
  return at->name;
}

std::string allowedFormats() {
  return "OBJ, 3DS, glTF 2.0 (.gltf, .glb), COLLADA (.dae), FBX, PLY and STL";
}

std::string textOf(const NodeSelection& nodes) {
  std::string text = nodes.part;
  for (const std::string& node : nodes.without) text += "\n" + node;
  return text;
}

NodeSelection nodeSelectionOf(std::string_view text) {
  NodeSelection nodes;
  std::size_t end = text.find('\n');
  nodes.part = text.substr(0, end);
  while (end != std::string_view::npos) {
    text.remove_prefix(end + 1);
    end = text.find('\n');
    nodes.without.emplace_back(text.substr(0, end));
  }
  return nodes;
}

}  // namespace stadion
