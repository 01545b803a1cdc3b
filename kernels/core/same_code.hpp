#pragma once

/// Marks a function that every backend must run as the same machine code: neither inlined nor specialised for a caller.
/// (Left to the compiler, the same source for a base block was 35 % slower in one backend than in another.)
#if defined(__clang__)
#define PAIRSUM_SAME_CODE [[gnu::noinline]]
#else
#define PAIRSUM_SAME_CODE [[gnu::noipa]]
#endif
