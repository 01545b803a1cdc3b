#include <pairsum/core/isa.hpp>

#include <algorithm>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>

namespace pairsum {
namespace {

struct known_isa {
  std::string_view name;
  bool built, runs;
};

#if defined(__x86_64__) || defined(__i386__)
bool runs_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
}
bool runs_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
bool runs_sse4() { return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt"); }
#endif

constexpr bool is_built(std::string_view name) { return is_in(PAIRSUM_BUILT_ISAS, name); }

/// Best first.
std::vector<known_isa> known() {
#if defined(__x86_64__) || defined(__i386__)
  return {{"avx512", is_built("avx512"), runs_avx512()},
          {"avx2", is_built("avx2"), runs_avx2()},
          {"sse4", is_built("sse4"), runs_sse4()},
          {"neon", false, false}};
#elif defined(__aarch64__)
  return {{"avx512", false, false}, {"avx2", false, false}, {"sse4", false, false}, {"neon", is_built("neon"), true}};
#else
  return {{"avx512", false, false}, {"avx2", false, false}, {"sse4", false, false}, {"neon", false, false}};
#endif
}

}  // namespace

std::vector<std::string_view> isa_names() {
  std::vector<std::string_view> names;
  for (const known_isa& k : known())
    if (k.built && k.runs) names.push_back(k.name);
  return names;
}

void check_isa(std::string_view isa) {
  std::vector<std::string_view> valid{scalar_isa, best_isa};
  for (const std::string_view name : isa_names()) valid.push_back(name);
  for (const known_isa& k : known()) {
    if (k.name != isa || (k.built && k.runs)) continue;
    const std::string why =
        k.built ? "does not run on this machine" : "is not in this build; configure with -DPAIRSUM_ISAS=all";
    throw unavailable("isa " + std::string(isa) + " " + why + " (valid: " + join(valid) + ")");
  }
  check_word("isa", std::string(isa), valid);
}

}  // namespace pairsum
