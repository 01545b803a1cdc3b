#pragma once
// Highway for the one instruction set that the compiler's flags name; which set runs is decided by whoever calls.
#ifndef HWY_COMPILE_ONLY_STATIC
#define HWY_COMPILE_ONLY_STATIC
#endif
#include <hwy/highway.h>
