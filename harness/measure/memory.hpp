#pragma once
#include <cstdint>
#include <optional>

namespace pairsum::harness {

/// Keeps freed memory in the process, so that a later measurement does not pay for page faults of an earlier one's
/// memory.
void keep_freed_memory();

/// Bytes of the heap that are in use, over all threads; empty where the allocator does not report it.
std::optional<std::uint64_t> heap_bytes();

/// Restarts the kernel's record of the largest resident set of this process, where the kernel allows it.
void reset_peak_rss();
/// Largest resident set in bytes since the last reset; empty where /proc does not report it.
std::optional<std::uint64_t> peak_rss_bytes();

}  // namespace pairsum::harness
