#pragma once
// Highway for the one instruction set that the compiler's flags name; the caller decides which set runs.
#ifndef HWY_COMPILE_ONLY_STATIC
#define HWY_COMPILE_ONLY_STATIC
#endif
#ifndef HWY_IS_DEBUG_BUILD
#define HWY_IS_DEBUG_BUILD 0  // its assertions, on without optimisation and under sanitizers, need Highway's library
#endif
#include <hwy/highway.h>
