#pragma once
/// Eigen as every file of ours sees it: for the baseline instruction set, whatever the compiler is told to
/// use.
///
/// Where Eigen sees AVX or FMA, it multiplies and adds in one (which `-ffp-contract=off` does not forbid),
/// adds in another order, and aligns its types otherwise, so that those in FCL's interfaces are other types
/// than the library was built with. What the compiler itself makes of such instructions
/// changes no result.

#pragma push_macro("__SSE3__")
#pragma push_macro("__SSSE3__")
#pragma push_macro("__SSE4_1__")
#pragma push_macro("__SSE4_2__")
#pragma push_macro("__AVX__")
#pragma push_macro("__AVX2__")
#pragma push_macro("__FMA__")
#pragma push_macro("__F16C__")
#pragma push_macro("__AVX512F__")
#undef __SSE3__
#undef __SSSE3__
#undef __SSE4_1__
#undef __SSE4_2__
#undef __AVX__
#undef __AVX2__
#undef __FMA__
#undef __F16C__
#undef __AVX512F__

#include <Eigen/Core>

#include <Eigen/Geometry>
#include <Eigen/LU>

#pragma pop_macro("__SSE3__")
#pragma pop_macro("__SSSE3__")
#pragma pop_macro("__SSE4_1__")
#pragma pop_macro("__SSE4_2__")
#pragma pop_macro("__AVX__")
#pragma pop_macro("__AVX2__")
#pragma pop_macro("__FMA__")
#pragma pop_macro("__F16C__")
#pragma pop_macro("__AVX512F__")

static_assert(EIGEN_MAX_ALIGN_BYTES == 16, "include this before anything else of Eigen");
