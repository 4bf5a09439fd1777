#pragma once
/// Eigen for all our files: for the baseline instruction set, whatever the compiler's options.
///
/// If Eigen sees AVX or FMA, it fuses multiplications and additions (which `-ffp-contract=off` does not
/// forbid), adds in another order, and aligns its types differently. The types in FCL's interfaces would then
/// differ from those with which the library was built. Such instructions from the compiler itself change no
/// result.

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
