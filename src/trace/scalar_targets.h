#pragma once

/// Include before anything of Highway in a file whose kernels are scalar: two versions are enough, one for any machine
/// and one with fused multiply-add, the only instruction that matters to them.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3)
