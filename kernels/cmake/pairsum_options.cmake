# What every target of the project is compiled with.
add_compile_options(-Wall -Wextra)
# g++ 12 takes every `"word" + string` that it inlines for one that overlaps itself (GCC bug 105651), and finds what is not
# initialised in its own headers of vector instructions (105593).
add_compile_options("$<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict;-Wno-maybe-uninitialized>")

# What the library and those who use it must agree on, since its templates are compiled by both.
add_library(pairsum_options INTERFACE)
target_compile_features(pairsum_options INTERFACE cxx_std_20)
target_compile_options(pairsum_options INTERFACE -fno-math-errno -fno-trapping-math)
# A source holds many formulas, and g++ stops inlining in one that has grown by 40 %: sums would call functions of a few
# instructions and take 2 to 3 times as long.
target_compile_options(pairsum_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=inline-unit-growth=1000>)
if(PAIRSUM_NATIVE)
  target_compile_options(pairsum_options INTERFACE -march=native)
endif()

# g++ tidies up its memory each time it has grown by 128 MB, a twentieth of the time of a source that takes a GB.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)

# For code that is never timed: it compiles in half the time.
add_library(pairsum_cold INTERFACE)
target_compile_options(pairsum_cold INTERFACE $<$<CONFIG:Release,RelWithDebInfo>:-Og> $<$<CONFIG:Dev,Asan>:-O0>)

# The same for tests that sum with templates of their own: under the sanitizers, without any optimisation they take minutes.
add_library(pairsum_cool INTERFACE)
target_compile_options(pairsum_cool INTERFACE $<$<CONFIG:Release,RelWithDebInfo,Asan>:-O1> $<$<CONFIG:Dev>:-O0>)
