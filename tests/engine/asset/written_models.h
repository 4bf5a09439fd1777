#pragma once
// Small models in text formats: a wedge whose corners lie at 0, 1 m on x, 2 m on y and 3 m on z.

#include <string>

namespace stadion::test {

/// A P line of FBX.
inline std::string fbxSetting(const std::string& name, const std::string& type, const std::string& value) {
  return "P: \"" + name + "\", \"" + type + "\", \"\", \"\"," + value + "\n";
}

/// The wedge in FBX with these settings of axes and unit; its vertices are given in the file's own axes.
inline std::string fbxWedge(const std::string& settings, const std::string& vertices) {
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n"
         "GlobalSettings:  {\nVersion: 1000\nProperties70:  {\n" +
         settings +
         "}\n}\nObjects:  {\nGeometry: 1000, \"Geometry::wedge\", \"Mesh\" {\nVertices: *12 {\na: " +
         vertices +
         "\n}\nPolygonVertexIndex: *12 {\na: 0,2,-2,0,1,-4,1,2,-4,2,0,-4\n}\nGeometryVersion: 124\n}\n"
         "Model: 2000, \"Model::wedge\", \"Mesh\" {\nVersion: 232\n}\n}\n"
         "Connections:  {\nC: \"OO\",2000,0\nC: \"OO\",1000,2000\n}\n";
}

/// Axes: right, up and to the viewer, as an axis from 0 to 2 and a sign.
inline std::string fbxAxes(int right, int rightSign, int up, int upSign, int front, int frontSign) {
  std::string text;
  const auto axis = [&](const char* name, int number, int sign) {
    text += fbxSetting(name + std::string("Axis"), "int", std::to_string(number)) +
            fbxSetting(name + std::string("AxisSign"), "int", std::to_string(sign));
  };
  axis("Coord", right, rightSign);
  axis("Up", up, upSign);
  axis("Front", front, frontSign);
  return text;
}

/// As Blender and 3ds Max write it: +Z up, centimetres.
inline std::string fbxZUpCentimetres() {
  return fbxWedge(fbxAxes(0, 1, 2, 1, 1, -1) + fbxSetting("UnitScaleFactor", "double", "1"),
                  "0,0,0,100,0,0,0,200,0,0,0,300");
}

/// The wedge in PLY with coloured corners.
inline std::string plyWedge() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 4\n"
         "property list uchar int vertex_indices\nend_header\n"
         "0 0 0 255 0 0\n1 0 0 0 255 0\n0 2 0 0 0 255\n0 0 3 255 255 255\n"
         "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
}

}  // namespace stadion::test
