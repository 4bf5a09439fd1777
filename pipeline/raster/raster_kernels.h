#pragma once
/// Draws small triangles into a picture, several at a time, as OpenGL draws them (3.3 core, 3.6.1). Internal
/// to pipeline/gl_draw/.
///
/// Corners lie on a grid of 1/256 pixel. A pixel is drawn if its middle is inside, or on a left or lower
/// edge. Depths are linear in the picture, colours in space.
///
/// Includes  nothing: the file that is compiled for AVX2 uses this, too, and must share no function.

namespace stadion {

/// Larger triangles are not small: their edges would overflow the sums below [pixels].
constexpr float kMostSmall = 62;

/// Vertices with their normals, in mesh coordinates, and their colours, 0 .. 1. Room for a multiple of eight.
struct VerticesToShade {
  const float *nx, *ny, *nz, *r, *g, *b;
};

/// Matches uniform_blocks.h, for the plain look.
struct ShadingLight {
  float direction[3];  ///< towards the light, unit
  float colour[3];
};
struct Shading {
  float normals[9];  ///< (3 x 3), row major: from normals in the mesh to normals in World, of any length
  float base[3], emissive[3];  ///< colours of the material
  float ambient[3];
  const ShadingLight* lights;
  unsigned lightCount;
};

/// Places of vertices in the picture [pixels from its middle, which is rounded down], their nearness, 1 / w
/// [1/m], and their brightness.
struct PictureVertices {
  const float *x, *y, *nearness;
  float *r, *g, *b;
};

/// The picture, rows from the bottom (height x width).
struct RasterTarget {
  unsigned* colours;  ///< red in the lowest byte
  float* depths;      ///< 1 at the near plane, 0 at the far one; a nearer pixel replaces the stored one
  int width, height;
  float depthScale, depthOffset;  ///< depth = scale x nearness + offset
};

struct RasterKernels {
  /// Computes the brightness of vertices [first, end).
  void (*shade)(const VerticesToShade& vertices, unsigned first, unsigned end, const Shading& by,
                const PictureVertices& out);
  /// Draws triangles, three corners each. `facing`: 1 = counter-clockwise ones are seen, -1 = clockwise ones,
  /// 0 = both. For two triangles at the same depth, the visible one does not depend on their order.
  void (*draw)(const unsigned* corners, unsigned triangles, const PictureVertices& vertices, float facing,
               const RasterTarget& to);
};

/// Four at a time, on every machine.
extern const RasterKernels kRasterByFour;
/// Eight at a time, on machines with AVX2. Both give the same bits.
extern const RasterKernels kRasterByEight;

}  // namespace stadion
