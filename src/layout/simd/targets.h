#pragma once

/// Include before anything of Highway in every kernel file: the instruction sets worth their compile time. Machines
/// without SSE4 run the portable emulation.
#define HWY_DISABLED_TARGETS HWY_SSSE3
