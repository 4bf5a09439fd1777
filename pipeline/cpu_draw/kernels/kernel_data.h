#pragma once
/// Plain data that the kernels of the CPU renderer read and write.
///
/// Frames   pixels count from the lower left of the picture, x to the right, y up. Positions are World axes
///          relative to the draw list's origin.
/// Depth    a number that grows towards the eye and is linear in the picture: 1 / w for a perspective
///          [1/m], the clip z for a parallel projection.
/// Includes nothing: files that are compiled for other instruction sets use this header, too, and must share
///          no function.

namespace stadion {

constexpr int kKernelPadding = 16;  ///< arrays have room for so many more values than they hold
constexpr int kBandRows = 16;       ///< rows of a picture that are drawn together
constexpr int kSurfaceFloats = 48;
constexpr int kRunPixels = 8;  ///< pixels of a run: stretches of a row that begin at a multiple of it

/// Places of samples in a pixel, in parts of 2 * samples. In each row and column of that grid there is one.
constexpr int kOneSample[1][2] = {{1, 1}};
constexpr int kTwoSamples[2][2] = {{1, 3}, {3, 1}};
constexpr int kFourSamples[4][2] = {{3, 1}, {7, 3}, {1, 5}, {5, 7}};
constexpr int kEightSamples[8][2] = {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};

/// Vertex positions of a mesh, padded.
struct MeshPositions {
  const float *x, *y, *z;
};

/// Maps mesh coordinates to pixels: rows for x * w, y * w and w. In a parallel projection w is 1 and the last
/// row gives the depth.
struct PixelMatrix {
  float x[4], y[4], w[4];
};

/// Vertices in the picture, padded: x and y [pixels], depth, and a number without meaning.
struct PlacedVertices {
  float* at;
};

constexpr int kVertexFloats = 12;  ///< position (3), normal (3), texture coordinates (2), colour (4)

/// Corners of triangles: numbers of vertices, padded.
struct TriangleCorners {
  const int *a, *b, *c;
};

/// Parameters of triangle setup.
struct SetupParameters {
  int width, height;  ///< size of the picture [pixels]
  int samples;        ///< for each pixel: 1, 2, 4 or 8
  float facing;       ///< 1: counter-clockwise triangles are visible, -1: clockwise ones, 0: both
  float mirrored;     ///< -1 if the front of a triangle is clockwise, else 1
  float leastDepth;   ///< depths at or below are behind the eye
  float mostDepth;    ///< depth of the near plane
  float slopeOffset;  ///< added to depths: a multiple of the greater slope [depth a pixel]
  float stepOffset;   ///< added to depths: a multiple of the smallest step at the triangle's depth
  unsigned source;    ///< goes into the records
};

enum TriangleFlags : unsigned {
  kLongEdgeIsLeft = 1,  ///< the edge from the lowest to the highest corner bounds the triangle on the left
  kFacesAway = 2,       ///< its back is seen
  kUnfinished = 4,      ///< crosses the near plane or is too large: TriangleClipper finishes it
  kGrown = 8,           ///< covers 1/256 pixel more on either side, so that no gap opens beside its neighbour
  kClipped = 16,        ///< TriangleClipper has made it
};
constexpr int kFlagBits = 5;

/// A triangle to draw. The inside of a row lies between the long edge and one of the two short edges; so
/// neighbours that share an edge compute the same border from the same numbers and never leave a gap.
struct TriangleRecord {
  float x0, y0;             ///< lowest corner
  float x1, y1;             ///< middle corner
  float y2;                 ///< height of the highest corner
  float slopeLong;          ///< x a row along the edge from the lowest to the highest corner
  float slopeLow;           ///< from the lowest to the middle corner
  float slopeHigh;          ///< from the middle to the highest corner
  float depthX, depthY;     ///< change of the depth for each pixel
  float depth;              ///< at the lower left of pixel (left, low)
  float mostDepth;          ///< largest depth of the three corners
  short left, low;          ///< first pixel that may be covered
  short right, high;        ///< last one
  unsigned triangle;        ///< number among the corners that were set up
  unsigned sourceAndFlags;  ///< SetupParameters::source << kFlagBits, and flags
};
static_assert(sizeof(TriangleRecord) == 64);

constexpr unsigned kNoTriangle = ~0U;

/// Samples of a band of rows. The samples of a pixel lie next to each other.
struct BandSamples {
  float* depth;
  unsigned* triangle;  ///< number of the record that is seen, or kNoTriangle
  int stride;          ///< samples a row
  int low, end;        ///< rows of the picture: low .. end - 1
};

/// A pixel of a transparent triangle.
struct LayerFragment {
  unsigned pixel;     ///< x + 65536 * y
  unsigned triangle;  ///< number of the record
  unsigned samples;   ///< bit for each sample that it covers and that nothing opaque hides
};

/// A pixel with samples of several triangles. Their colours lie at the places [first, first + count).
struct SharedPixel {
  unsigned place;
  unsigned first, count;
};

/// Fragments: pixels of visible triangles, in any order.
struct FragmentList {
  unsigned* number;  ///< of the triangle; the one after the last is the sky
  unsigned* pixel;   ///< x + 65536 * y
  unsigned* place;   ///< where the colour goes
  unsigned size;
  unsigned* times;  ///< by number: how many fragments there are
};

/// Pixels of a row whose fragments are to be found.
struct FragmentSearch {
  const unsigned* shown;  ///< numbers of triangles, or kNoTriangle: the samples of the pixels
  int samples, x, y;      ///< of the first pixel
  int width;              ///< pixels
  unsigned place;         ///< of the first pixel
  unsigned sky;           ///< the number of the sky
  FragmentList* runs;     ///< stretches of kRunPixels pixels that show one triangle
  FragmentList* ones;     ///< all others
  SharedPixel* shared;
  unsigned sharedSize;
  float* weight;  ///< of the fragments of shared pixels, from `firstPart` on
  unsigned firstPart, parts;
};

/// A visible triangle as shading needs it: kSurfaceFloats numbers.
///
///   0 ..  2   barycentric weight of the first corner, before division by the sum: for each pixel to the
///             right, for each pixel up, at the origin;  3: origin x [pixels]
///   4 ..  6   likewise of the second corner;            7: origin y [pixels]
///   8 .. 10   likewise of the third corner;            11: 1 if the front is seen, -1 if the back is
///  12, 24, 36 the corners: normal (3), position (3), texture coordinates (2), vertex colour (3), alpha with
///             that of the material (1)
///
/// In the plain look the vertex colour is the colour of the lit corner, and its normal's x is the clearness
/// of the air.
struct SurfaceBlock {
  float at[kSurfaceFloats];
};

constexpr int kExtraVertexFloats = 8;  ///< tangent (3), side of the bitangent, second texture coordinates (2)
constexpr int kExtraSurfaceFloats = 24;  ///< likewise, of three corners

/// What materials with further maps need beside a SurfaceBlock: kExtraVertexFloats of each corner, in World
/// axes. Only of meshes that have it.
struct SurfaceExtra {
  float at[kExtraSurfaceFloats];
};

/// Visible triangles of one instance, of which shading needs a SurfaceBlock.
struct SurfaceJob {
  const TriangleRecord* const* triangles;
  unsigned count;
  TriangleCorners corners;
  const float* vertices;  ///< kVertexFloats each
  PlacedVertices placed;
  bool parallel;
  const float* model;    ///< (3 x 4), row major: mesh coordinates to World axes
  const float* normals;  ///< (3 x 3), row major: normals to World axes, of any length
  float alpha;           ///< of the material
  SurfaceBlock* out;
};

enum class TextureWrap : int { Repeat, Clamp, Mirror };

/// A texture with its mipmaps. Colours are square roots of linear light in the full look, as stored in the
/// plain look; alpha is linear. Red is in the lowest byte.
struct TextureParameters {
  static constexpr int kMostLevels = 16;
  const unsigned* texels;  ///< null: there is none
  int levels;
  int width[kMostLevels], height[kMostLevels];
  int first[kMostLevels];  ///< a level's first texel; a row has width + 1 texels, the last repeats the first
  TextureWrap wrapU, wrapV;
  float transform[6];    ///< (2 x 3), row major: applied to the coordinates
  int coordinates;       ///< the set of texture coordinates, 0 or 1
  int magnifiesNearest;  ///< 1: the nearest texel, not a mean of four
  int minifiesNearest;   ///< likewise, where it is reduced
  int mipmaps;           ///< 0: two levels, blended; 1: the nearest one; 2: the texture itself
  int unusual;           ///< 1: it does not repeat, or is not read as a blend of four texels of two levels
};

/// Parameters of a surface's material. The uniform blocks of the OpenGL programs have the same ones. A map that
/// is not there has no texels.
struct MaterialParameters {
  float baseColour[4];  ///< linear in the full look, alpha
  float emissive[3];
  float roughness, metallic;
  float alphaCutoff;  ///< 0: nothing is cut out
  float normalScale;  ///< strength of the normal map
  float occlusionStrength;
  int unlit, doubleSided;
  int mapped;    ///< 1: has a metallic-roughness, normal or occlusion map
  int tangents;  ///< 1: its mesh has tangents
  TextureParameters base, metallicRoughness, normal, occlusion, glow;
};

struct LightParameters {
  float position[3], perRangeSquared;
  float towards[3];  ///< the light, unit
  int kind;          ///< 0 directional, 1 point, 2 spot
  float colour[3];
  float coneOuter, perCone;
  int fallsOff;  ///< 1: with the square of the distance
};

/// Light from all around (engine/environment/environment_light.h). The uniform block has the same numbers.
struct EnvironmentParameters {
  static constexpr int kMaps = 8;
  float harmonics[9][3];  ///< factors of 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy
  float turnCos, turnSin, intensity;
  const unsigned* texels;   ///< of all maps; null: shiny surfaces mirror the harmonics
  int first[16];            ///< by map: its first texel; eight of them, as in `side`
  int side[16];             ///< [texels]
  const unsigned* picture;  ///< what is seen behind everything; null: the sky
  int pictureSide;
};

/// Light and air of a frame.
struct SceneParameters {
  static constexpr int kMostLights = 16;
  float zenith[3], horizon[3], ground[3], ambient[3];
  float perHaze;  ///< 1 / haze distance [1/m], or 0
  float sunDirection[3], sunColour[3];
  float sunShare;  ///< 1 if there is a sun, else 0
  int lights;
  int shadowed;                              ///< the light that casts shadows, or -1
  int steep;                                 ///< 1: a light falls off with the square of the distance
  const EnvironmentParameters* environment;  ///< null: `ambient` lights
  int toned;                                 ///< 1: there is an exposure, or another curve than the soft one
  int curve;                                 ///< 0 soft, 1 clamp, 2 neutral, 3 aces
  float exposure;                            ///< what light is multiplied with
  LightParameters light[kMostLights];
};

constexpr int kShadowSide = 2048;  ///< texels of all rings' maps together, two by two
constexpr int kShadowTile = 2;     ///< texels a side for which the least and the greatest depth are known

/// Shadow maps. Depths are 1 towards the light.
struct ShadowParameters {
  float right[3], up[3], towards[3];
  float depthScale;     ///< [1/m]
  float rings[4][4];    ///< offset in the map, offset in depth, scale
  float lift[4];        ///< along the normal [m]
  const float* depths;  ///< (kShadowSide x kShadowSide); null: nothing casts a shadow
  const float* bounds;  ///< least and greatest depth of each tile and its three next texels
  int taps;             ///< texels that are compared: 16 or 4
};

/// The eye.
struct ViewParameters {
  float eye[3];
  float ray[3], rayX[3], rayY[3];  ///< direction at the lower left, and its change for each pixel
};

/// Fragments of one material to shade. Arrays are padded.
struct FragmentJob {
  const SurfaceBlock* surfaces;
  const SurfaceExtra* extras;  ///< likewise; null: no mesh of the picture has any
  const unsigned* pixel;       ///< by fragment: x + 65536 * y
  const unsigned* surface;     ///< by fragment: its surface
  const unsigned* place;       ///< by fragment: where its colour goes
  unsigned count;
  int runs;        ///< 1: each of them stands for kRunPixels pixels to the right
  float* colours;  ///< red, green, blue and alpha, linear (in the plain look: as stored)
  const MaterialParameters* material;
  const SceneParameters* scene;
  const ShadowParameters* shadow;
  const ViewParameters* view;
  int nearestLevel;  ///< 1: textures are read from one level
};

constexpr int kEncodedSteps = 16383;

/// The kernels. All of them give the same bits for the same input, however many lanes they have.
struct DrawKernels {
  const char* name;
  /// Places vertices in the picture. `parallel`: the projection has no vanishing point.
  void (*place)(const MeshPositions& from, unsigned count, const PixelMatrix& by, bool parallel,
                const PlacedVertices& to);
  /// Writes a record for each of the triangles [first, first + count) that may cover a sample. Returns their
  /// number; expects room for `count`.
  unsigned (*setUp)(const TriangleCorners& corners, unsigned first, unsigned count, const PlacedVertices& at,
                    const SetupParameters& by, TriangleRecord* out);
  /// Draws triangles into a band, numbered from `first` on; the later one of two at the same depth is seen.
  /// `present`: for each sample of the band, -1 if the triangles are there, 0 if they have a hole; null: they
  /// have none.
  void (*cover)(const TriangleRecord* const* triangles, unsigned count, unsigned first, int samples,
                const int* present, const BandSamples& band);
  /// Likewise, depths alone.
  void (*coverDepth)(const TriangleRecord* const* triangles, unsigned count, const int* present,
                     const BandSamples& band);
  /// Lists the pixels of a transparent triangle that nothing opaque hides. Returns their number; expects room
  /// for every pixel of its box.
  unsigned (*coverLayer)(const TriangleRecord& triangle, unsigned number, int samples, const int* present,
                         const BandSamples& band, LayerFragment* out);
  /// Appends the fragments of a row.
  void (*findFragments)(FragmentSearch& row);
  void (*makeSurfaces)(const SurfaceJob& job);
  /// For each fragment: whether the material has no hole there (-1, else 0).
  void (*cutOut)(const FragmentJob& job, int* present);
  void (*shade)(const FragmentJob& job);
  void (*shadePlain)(const FragmentJob& job);
  void (*sky)(const FragmentJob& job);
  void (*skyPlain)(const FragmentJob& job);
  /// Encodes colours as bytes: red, green, blue, 255. `steps`: the byte of each of kEncodedSteps + 1 steps of
  /// light; null: colours are stored as they are.
  void (*encode)(const float* colours, unsigned count, const unsigned char* steps, unsigned char* out);
};

extern const DrawKernels kDrawByFour;     ///< on every machine
extern const DrawKernels kDrawByEight;    ///< on machines with AVX2
extern const DrawKernels kDrawBySixteen;  ///< on machines with AVX-512

}  // namespace stadion
