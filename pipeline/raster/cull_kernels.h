#pragma once
/// Finds the triangles of a placed mesh that make pixels, several at a time. Internal to pipeline/raster/.
///
/// A triangle makes none if it faces away, or if no pixel's middle lies between its edges, vertically or
/// horizontally. OpenGL draws the pixels with their middles inside (OpenGL 3.3 core, 3.6.1), after it has
/// moved corners onto a grid.
///
/// Includes  nothing: the file that is compiled for AVX2 uses this, too, and must share no function.

namespace stadion {

/// From mesh coordinates to the picture: x = (row . p) / (w . p), in pixels from the picture's middle, which
/// is rounded down to a whole number of pixels.
struct PictureMatrix {
  float x[4], y[4], w[4];
};

/// The largest error of corners by grid and rounding [pixels].
constexpr float kSnapping = 1.0f / 64;
/// The largest coordinate of corners [pixels]; beyond it coordinates are too coarse.
constexpr float kFarthest = 16000;
constexpr float kNearest = 1e-3f;  ///< to the eye's plane [m]

/// Surfaces drawn so far, in squares of kSquare pixels from the picture's lower left. For each square: the
/// least nearness, 1 / w [1/m], of its pixels.
struct SeenSquares {
  const float* nearness;  ///< (high x wide); null = nothing is drawn yet
  int wide, high;
  float middleX, middleY;  ///< origin of pixel coordinates, from the lower left [pixels]
};
constexpr int kSquare = 4;  ///< [pixels]

/// From depths of a picture, 1 at the near plane and 0 at the far one, to nearness: scale depth + offset.
struct NearnessOfDepth {
  float scale, offset;
};

/// The bounds of vertices [pixels], and the nearness of the nearest [1/m].
struct PictureBounds {
  float left, right, low, high, nearest;
};

struct CullKernels {
  /// Writes the places of `count` vertices, a multiple of eight, in the picture, and their nearness. Returns
  /// false if this is not possible for all of them.
  bool (*project)(const float* x, const float* y, const float* z, unsigned count, const PictureMatrix& matrix,
                  float* px, float* py, float* nearness, PictureBounds& bounds);
  /// Writes the corners of those of `count` triangles that may make pixels, and returns the number of
  /// corners. `facing`: 1 = counter-clockwise ones are seen, -1 = clockwise ones, 0 = both. Reads seven
  /// triangles past the last one.
  unsigned (*keep)(const int* a, const int* b, const int* c, unsigned count, const float* px, const float* py,
                   const float* nearness, float facing, const SeenSquares& seen, unsigned* out);
  /// Writes the least nearness of each square from a picture's depths (height x width), rows from the bottom.
  void (*squares)(const float* depths, int width, int height, const NearnessOfDepth& of, float* nearness);
};

/// Four at a time, on every machine.
extern const CullKernels kCullByFour;
/// Eight at a time, on machines with AVX2. Both give the same bits.
extern const CullKernels kCullByEight;

}  // namespace stadion
