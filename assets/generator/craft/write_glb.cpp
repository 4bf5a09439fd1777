#include "assets/generator/craft/glb_writer.h"

#include <bit>
#include <cstdio>

namespace stadion::assets {
namespace glb {

void putWord(std::string& out, std::uint32_t v) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(v >> shift & 255));
}

void put16(std::string& out, std::uint32_t v) {
  for (int shift = 0; shift < 16; shift += 8) out.push_back(static_cast<char>(v >> shift & 255));
}

void putFloat(std::string& out, double v) {
  putWord(out, std::bit_cast<std::uint32_t>(static_cast<float>(v) + 0.0f));  // + 0 makes -0 equal to 0
}

void putPoint(std::string& out, Point p) {
  putFloat(out, p.x), putFloat(out, p.z), putFloat(out, -p.y);
}

std::string joined(const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += (out.empty() ? "" : ",\n") + item;
  return "[" + out + "]";
}

}  // namespace glb

namespace {

char linearByte(double srgb) {
  const double c = std::clamp(srgb, 0.0, 1.0);
  const double linear = c <= 0.04045 ? c / 12.92 : det::pow((c + 0.055) / 1.055, 2.4);
  return static_cast<char>(static_cast<int>(linear * 255 + 0.5));
}

char signedByte(double v) {
  return static_cast<char>(static_cast<int>(std::floor(127 * v + 0.5)));
}

}  // namespace

void GlbWriter::primitive(const Part& part, const std::string& more, bool quantized) {
  const auto count = static_cast<unsigned>(part.vertices.size());
  std::string positions, colours, uvs, normals, corners;
  Point low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  const bool narrow = count < 65535;
  bool smoothed = true;
  for (const Vertex& v : part.vertices) {
    glb::putPoint(positions, v.p);
    const Point p{v.p.x, v.p.z, -v.p.y};
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    for (double c : {v.colour.x, v.colour.y, v.colour.z}) colours.push_back(linearByte(c));
    colours.push_back(static_cast<char>(255));
    glb::putFloat(uvs, v.uv[0]), glb::putFloat(uvs, v.uv[1]);
    if (quantized)
      for (const double n : {v.n.x, v.n.z, -v.n.y, 0.0}) normals.push_back(signedByte(n));
    else
      glb::putPoint(normals, v.n);
    smoothed = smoothed && dot(v.n, v.n) > 0;
  }
  for (const auto& t : part.triangles)
    for (std::uint32_t c : t) narrow ? glb::put16(corners, c) : glb::putWord(corners, c);
  while (corners.size() % 4 != 0) corners.push_back(0);
  std::string attributes =
      glb::text("\"POSITION\":%d", accessor(positions, 34962, count, 5126, "VEC3",
                                            glb::text(",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]",
                                                      low.x, low.y, low.z, high.x, high.y, high.z)));
  attributes +=
      glb::text(",\"COLOR_0\":%d", accessor(colours, 34962, count, 5121, "VEC4", ",\"normalized\":true"));
  if (!part.finish.picture.empty())
    attributes += glb::text(",\"TEXCOORD_0\":%d", accessor(uvs, 34962, count, 5126, "VEC2", ""));
  if (smoothed && quantized)
    attributes +=
        glb::text(",\"NORMAL\":%d", accessor(normals, 34962, count, 5120, "VEC3", ",\"normalized\":true", 4));
  else if (smoothed)
    attributes += glb::text(",\"NORMAL\":%d", accessor(normals, 34962, count, 5126, "VEC3", ""));
  const int indices = accessor(corners, 34963, static_cast<unsigned>(3 * part.triangles.size()),
                               narrow ? 5123 : 5125, "SCALAR", "");
  primitives_.push_back("{\"attributes\":{" + attributes + more +
                        glb::text("},\"indices\":%d,\"material\":%d}", indices, material(part.finish)));
}

void GlbWriter::add(const SkinnedPart& skinned, bool narrow) {
  std::string joints, weights;
  std::array<char, 4> weight_of{};
  for (const Carriers& c : skinned.carriers) {
    for (const int bone : c.bone)
      narrow ? joints.push_back(static_cast<char>(bone))
             : glb::put16(joints, static_cast<std::uint32_t>(bone));
    // In steps of 1/255, whose sum is 1.
    int left = 255;
    for (std::size_t k = 3; k > 0; --k) {
      const int part = static_cast<int>(255 * c.weight[k] + 0.5);
      weight_of[k] = static_cast<char>(part), left -= part;
    }
    weight_of[0] = static_cast<char>(left);
    weights.append(weight_of.data(), weight_of.size());
  }
  const std::size_t count = skinned.carriers.size();
  const int joint = accessor(joints, 34962, count, narrow ? 5121 : 5123, "VEC4", "");
  const int weight = accessor(weights, 34962, count, 5121, "VEC4", ",\"normalized\":true");
  primitive(skinned.part, glb::text(",\"JOINTS_0\":%d,\"WEIGHTS_0\":%d", joint, weight), true);
}

std::string GlbWriter::take(const std::string& nodes, const std::string& more) {
  std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"stadion-assets\"},\"scene\":0," +
                     nodes + ",\n\"meshes\":[{\"primitives\":" + glb::joined(primitives_) +
                     "}],\n\"materials\":" + glb::joined(materials_) + more;
  if (!pictures_.empty()) {
    std::vector<std::string> images, textures;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      images.push_back("{\"uri\":\"" + pictures_[i] + "\"}");
      textures.push_back(glb::text("{\"source\":%d}", static_cast<int>(i)));
    }
    json += ",\n\"images\":" + glb::joined(images) + ",\n\"textures\":" + glb::joined(textures);
  }
  if (!clips_.empty()) {
    while (numbers_.size() % 4 != 0) numbers_.push_back(0);
    views_[0] =
        glb::text("{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", numbers_.size(), clips_.size());
    numbers_ += clips_;
  }
  json += ",\n\"accessors\":" + glb::joined(accessors_) + ",\n\"bufferViews\":" + glb::joined(views_) +
          glb::text(",\n\"buffers\":[{\"byteLength\":%d}]}", static_cast<int>(numbers_.size()));
  while (json.size() % 4 != 0) json.push_back(' ');
  std::string out = "glTF";
  glb::putWord(out, 2),
      glb::putWord(out, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + numbers_.size()));
  glb::putWord(out, static_cast<std::uint32_t>(json.size())), out += "JSON" + json;
  glb::putWord(out, static_cast<std::uint32_t>(numbers_.size())), out += std::string("BIN\0", 4) + numbers_;
  return out;
}

int GlbWriter::accessor(const std::string& bytes, int target, std::size_t count, int component,
                        const char* type, const std::string& more, int stride) {
  while (numbers_.size() % 4 != 0) numbers_.push_back(0);
  views_.push_back(
      glb::text("{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu", numbers_.size(), bytes.size()) +
      (stride == 0 ? "" : glb::text(",\"byteStride\":%d", stride)) +
      (target == 0 ? "}" : glb::text(",\"target\":%d}", target)));
  numbers_ += bytes;
  accessors_.push_back(glb::text("{\"bufferView\":%d,\"componentType\":%d,\"count\":%zu,\"type\":\"%s\"",
                                 static_cast<int>(views_.size()) - 1, component, count, type) +
                       more + "}");
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbWriter::clipAccessor(const std::string& bytes, std::size_t count, const char* type,
                            const std::string& more) {
  accessors_.push_back(glb::text("{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5126,\"count\":%zu,"
                                 "\"type\":\"%s\"",
                                 clips_.size(), count, type) +
                       more + "}");
  clips_ += bytes;
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbWriter::material(const Finish& finish) {
  std::string colour;
  if (!finish.picture.empty()) {
    const auto known = std::find(pictures_.begin(), pictures_.end(), finish.picture);
    colour = glb::text(",\"baseColorTexture\":{\"index\":%d}", static_cast<int>(known - pictures_.begin()));
    if (known == pictures_.end()) pictures_.push_back(finish.picture);
  }
  const std::string material =
      "{\"name\":\"" + finish.name + "\",\"pbrMetallicRoughness\":{" +
      glb::text("\"roughnessFactor\":%.3g,\"metallicFactor\":%.3g", finish.roughness, finish.metallic) +
      colour + "}}";
  const auto known = std::find(materials_.begin(), materials_.end(), material);
  const auto index = static_cast<int>(known - materials_.begin());
  if (known == materials_.end()) materials_.push_back(material);
  return index;
}

std::string toGlb(const Parts& parts) {
  GlbWriter writer;
  for (const Part& part : parts)
    if (!part.triangles.empty()) writer.add(part);
  return writer.take("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]");
}

}  // namespace stadion::assets
