#include "assets/generator/craft/models.h"

#include <bit>

// The file is a tree of chunks: a 16-bit kind, a 32-bit length that counts these six bytes, then contents.

namespace stadion::assets {
namespace {

enum Kind : std::uint16_t {
  Main = 0x4d4d,
  Version = 0x0002,
  Editor = 0x3d3d,
  MeshVersion = 0x3d3e,
  MasterScale = 0x0100,
  MaterialBlock = 0xafff,
  MaterialName = 0xa000,
  Ambient = 0xa010,
  Diffuse = 0xa020,
  Specular = 0xa030,
  Shininess = 0xa040,
  TextureMap = 0xa200,
  MapFile = 0xa300,
  Colour24 = 0x0011,
  Percent = 0x0030,
  NamedObject = 0x4000,
  TriangleMesh = 0x4100,
  Points = 0x4110,
  Faces = 0x4120,
  FaceMaterial = 0x4130,
  MapCoordinates = 0x4140,
  SmoothGroups = 0x4150,
  LocalAxes = 0x4160,
};

class Bytes {
public:
  Bytes& u8(unsigned v) { return text.push_back(static_cast<char>(v)), *this; }
  Bytes& u16(unsigned v) { return u8(v & 255).u8(v >> 8 & 255); }
  Bytes& u32(std::uint32_t v) { return u16(v & 0xffff).u16(v >> 16); }
  Bytes& f32(double v) { return u32(std::bit_cast<std::uint32_t>(static_cast<float>(v))); }
  Bytes& name(const std::string& s) { return text += s, u8(0); }
  Bytes& chunk(Kind kind, const Bytes& content) {
    u16(kind).u32(static_cast<std::uint32_t>(content.text.size() + 6));
    return text += content.text, *this;
  }
  std::string text;
};

Bytes colour(std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  return Bytes().chunk(Colour24, Bytes().u8(r).u8(g).u8(b));
}

Bytes percent(int value) {
  return Bytes().chunk(Percent, Bytes().u16(static_cast<unsigned>(value)));
}

Bytes material(const Paint& paint) {
  Bytes out;
  const auto& [r, g, b] = paint.colour;
  const auto shine = static_cast<std::uint8_t>(paint.gloss);
  out.chunk(MaterialName, Bytes().name(paint.name))
      .chunk(Ambient, colour(r, g, b))
      .chunk(Diffuse, colour(r, g, b));
  out.chunk(Specular, colour(shine, shine, shine)).chunk(Shininess, percent(paint.gloss));
  if (!paint.picture.empty()) {
    Bytes map = percent(100);
    out.chunk(TextureMap, map.chunk(MapFile, Bytes().name(paint.picture)));
  }
  return out;
}

Bytes faces(const Model& model) {
  Bytes out;
  out.u16(static_cast<unsigned>(model.triangles.size()));
  for (const Triangle& t : model.triangles)
    out.u16(t.corner[0]).u16(t.corner[1]).u16(t.corner[2]).u16(7);  // 7: all three edges are drawn
  for (std::uint32_t p = 0; p < model.paints.size(); ++p) {
    Bytes list;
    unsigned count = 0;
    for (std::uint32_t i = 0; i < model.triangles.size(); ++i)
      if (model.triangles[i].paint == p) list.u16(i), ++count;
    Bytes block;
    block.name(model.paints[p].name).u16(count).text += list.text;
    out.chunk(FaceMaterial, block);
  }
  Bytes smooth;  // one group: smooth all over
  for (std::size_t i = 0; i < model.triangles.size(); ++i) smooth.u32(1);
  return out.chunk(SmoothGroups, smooth);
}

Bytes mesh(const Model& model) {
  Bytes points, out;
  points.u16(static_cast<unsigned>(model.points.size()));
  for (const Point& p : model.points) points.f32(p.x).f32(p.y).f32(p.z);
  out.chunk(Points, points);
  if (!model.uvs.empty()) {
    Bytes uvs;
    uvs.u16(static_cast<unsigned>(model.uvs.size()));
    for (const auto& uv : model.uvs) uvs.f32(uv[0]).f32(uv[1]);
    out.chunk(MapCoordinates, uvs);
  }
  Bytes axes;
  for (double v : {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}) axes.f32(v);
  return out.chunk(LocalAxes, axes).chunk(Faces, faces(model));
}

}  // namespace

std::string to3ds(const Model& model) {
  Bytes editor;
  editor.chunk(MeshVersion, Bytes().u32(3));
  for (const Paint& paint : model.paints) editor.chunk(MaterialBlock, material(paint));
  editor.chunk(MasterScale, Bytes().f32(1));
  Bytes object;
  object.name(model.name).chunk(TriangleMesh, mesh(model));
  editor.chunk(NamedObject, object);
  Bytes content;
  content.chunk(Version, Bytes().u32(3)).chunk(Editor, editor);
  return Bytes().chunk(Main, content).text;
}

}  // namespace stadion::assets
