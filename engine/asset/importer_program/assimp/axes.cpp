#include "engine/asset/importer_program/assimp/axes.h"

#include "engine/asset/importer_program/source/up_axis.h"

#include <assimp/scene.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace stadion::importer {
namespace {

// The metres of <unit meter="..."> as assimp has already applied them, 1 if the file does not say.
double statedUnit(const std::vector<std::uint8_t>& file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const auto tag = text.find("<unit");
  const auto attribute = tag == std::string_view::npos ? tag : text.substr(0, tag + 200).find("meter=", tag);
  if (attribute == std::string_view::npos || attribute + 8 > text.size()) return 1;
  const std::string number(text.substr(attribute + 7, 32));
  const double unit = std::strtod(number.c_str(), nullptr);
  return unit > 0 && std::isfinite(unit) ? unit : 1;
}

double numberOf(const aiScene& scene, const char* key, double otherwise) {
  const aiMetadata* data = scene.mMetaData;
  if (double wide = 0; data && data->Get(key, wide)) return wide;
  if (float narrow = 0; data && data->Get(key, narrow)) return double{narrow};
  return otherwise;
}

std::optional<int> integerOf(const aiScene& scene, const char* key) {
  if (int32_t value = 0; scene.mMetaData && scene.mMetaData->Get(key, value)) return value;
  return {};
}

/// Returns the direction of an axis that an FBX file names, or nothing.
std::optional<Vec3> axisOf(const aiScene& scene, const std::string& name) {
  const auto axis = integerOf(scene, (name + "Axis").c_str());
  const int sign = integerOf(scene, (name + "AxisSign").c_str()).value_or(1);
  if (!axis || *axis < 0 || *axis > 2) return {};
  return sign < 0 ? Vec3(-Vec3::Unit(*axis)) : Vec3(Vec3::Unit(*axis));
}

/// FBX names the axes that point right, up and to the viewer. +Y of a show points away from the viewer.
Mat3 fbxTurn(const aiScene& scene) {
  const auto right = axisOf(scene, "Coord"), up = axisOf(scene, "Up"), front = axisOf(scene, "Front");
  Mat3 turn = toZUp(UpAxis::Y);
  if (!right || !up || !front) return turn;
  Mat3 stated;
  stated.row(0) = right->transpose();
  stated.row(1) = -front->transpose();
  stated.row(2) = up->transpose();
  return std::abs(stated.determinant()) > 0.5 ? stated : turn;
}

/// [m] Length of one unit of an FBX file, which states it in centimetres.
double fbxUnit(const aiScene& scene) {
  const double unit = numberOf(scene, "UnitScaleFactor", 1) / 100;
  return unit >= 1e-6 && unit <= 1e6 ? unit : 0.01;
}

double unitOf(const aiScene& scene, const FormatInfo& format, const RequestHead& head,
              const std::vector<std::uint8_t>& file) {
  if (head.unit > 0) return format.format == ModelFormat::Collada ? head.unit / statedUnit(file) : head.unit;
  return format.format == ModelFormat::Fbx ? fbxUnit(scene) : format.unit;
}

}  // namespace

Affine toShow(const aiScene& scene, const FormatInfo& format, const RequestHead& head,
              const std::vector<std::uint8_t>& file) {
  const bool stated = head.up != 0;
  Mat3 turn = toZUp(stated ? static_cast<UpAxis>(head.up - 1) : format.up);
  if (format.format == ModelFormat::ThreeDs) turn = turn * toZUp(UpAxis::Y);
  if (format.format == ModelFormat::Fbx && !stated) turn = fbxTurn(scene);
  Affine X = Affine::Identity();
  X.linear() = unitOf(scene, format, head, file) * turn;
  return X;
}

}  // namespace stadion::importer
