#pragma once
#include "layout/simd/wide_kernels.h"

namespace boxwood {

/// The best kernels this machine can run, for compressed nodes of N children: 8 or 16.
template <int N>
WideKernels compressed_kernels();

}  // namespace boxwood
