#pragma once
/// Which triangles of a placed mesh make pixels, several at a time. Internal to pipeline/raster/.
///
/// A triangle makes none if it is turned away, or if no pixel's middle lies between its edges, up and down or
/// left and right: OpenGL takes the pixels whose middles are inside (OpenGL 3.3 core, 3.6.1), with corners
/// moved onto a grid first.
///
/// Includes  nothing: the file that is compiled for AVX2 uses this, too, and must share no function.

namespace stadion {

/// From mesh coordinates to the picture: x = (row . p) / (w . p), in pixels from the picture's middle, which
/// is rounded down to a whole number of pixels.
struct PictureMatrix {
  float x[4], y[4], w[4];
};

/// By how much corners may be moved and misplaced by rounding [pixels].
constexpr float kSnapping = 1.0f / 64;
/// Corners beyond are not told of [pixels]: their coordinates are too coarse.
constexpr float kFarthest = 16000;
constexpr float kNearest = 1e-3f;  ///< to the eye's plane [m]

/// What is in front already, in squares of kSquare pixels from the picture's lower left: for each the
/// nearness, 1 / w [1/m], that what is seen in it has at least.
struct SeenSquares {
  const float* nearness;  ///< (high x wide); null = nothing is in front
  int wide, high;
  float middleX, middleY;  ///< where pixels are counted from, from the lower left [pixels]
};
constexpr int kSquare = 4;  ///< [pixels]

/// From depths of a picture, 1 at the near plane and 0 at the far one, to nearness: scale depth + offset.
struct NearnessOfDepth {
  float scale, offset;
};

/// Within which vertices lie [pixels], and how near the nearest is [1/m].
struct PictureBounds {
  float left, right, low, high, nearest;
};

struct SieveKernels {
  /// Writes where `count` vertices, a multiple of eight, lie in the picture, and how near. False if that
  /// cannot be told of all.
  bool (*project)(const float* x, const float* y, const float* z, unsigned count, const PictureMatrix& matrix,
                  float* px, float* py, float* nearness, PictureBounds& bounds);
  /// Writes the corners of those of `count` triangles that may make pixels, and returns how many corners.
  /// `facing`: 1 = counter-clockwise ones are seen, -1 = clockwise ones, 0 = both. Seven triangles behind the
  /// last one are read.
  unsigned (*keep)(const int* a, const int* b, const int* c, unsigned count, const float* px, const float* py,
                   const float* nearness, float facing, const SeenSquares& seen, unsigned* out);
  /// The least nearness of each square, of a picture's depths (height x width), rows from the bottom.
  void (*squares)(const float* depths, int width, int height, const NearnessOfDepth& of, float* nearness);
};

/// Four at a time, on every machine.
extern const SieveKernels kSieveByFour;
/// Eight, where there is AVX2. Both do the same to the bit.
extern const SieveKernels kSieveByEight;

}  // namespace stadion
