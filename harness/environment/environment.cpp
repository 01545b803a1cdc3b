#include "harness/environment/environment.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hwloc.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <chrono>
#include <nlohmann/json.hpp>

#include "build_info.hpp"
#include "harness/environment/machine.hpp"
#include "harness/plugin/plugins.hpp"
#include "harness/rows/hash_text.hpp"

namespace pairsum::harness {
namespace {

std::string compiler() {
#if defined(__clang__)
  return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("GNU {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::map<std::string, std::string> libraries() {
  std::map<std::string, std::string> all{
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"OpenMP", fmt::format("{}", _OPENMP)},
      {"oneTBB", TBB_runtime_version()},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"hwloc", fmt::format("{}.{}.{}", hwloc_get_api_version() >> 16, hwloc_get_api_version() >> 8 & 255u,
                            hwloc_get_api_version() & 255u)},
      {"nlohmann_json",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
  for (const auto& [name, file] : loaded_plugins()) all["plugin " + name] = file;
  return all;
}

}  // namespace

std::string compiled_isa() {
#if defined(__AVX512F__)
  return "avx512";
#elif defined(__AVX2__)
  return "avx2";
#elif defined(__SSE2__)
  return "sse2";
#elif defined(__ARM_NEON)
  return "neon";
#else
  return "generic";
#endif
}

std::string utc_now() {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const auto ms = duration_cast<milliseconds>(now.time_since_epoch()).count() % 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(system_clock::to_time_t(now)), ms);
}

std::string utc_stamp() {
  using namespace std::chrono;
  return fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(system_clock::to_time_t(system_clock::now())));
}

std::string describe_build() {
  return fmt::format("pairsum {} (git {}{})\ncompiler {}\nflags {}\nisa {}", PAIRSUM_VERSION, build::git,
                     build::dirty ? ", modified" : "", compiler(), PAIRSUM_FLAGS, compiled_isa());
}

environment_row describe_environment(const std::string& study, const std::string& binding,
                                     const std::string& counters) {
  const machine m = describe_machine();
  environment_row row;
  row.host = m.host;
  row.cpu = m.cpu;
  row.caches = m.caches;
  row.cores = m.cores;
  row.governor = m.governor;
  row.os_kernel = m.os_kernel;
  row.compiler = compiler();
  row.flags = PAIRSUM_FLAGS;
  row.libraries = libraries();
  row.git = build::git;
  row.dirty = build::dirty;
  row.binding = binding;
  row.counters = counters;
  row.limits = m.limits;
  row.environment = hash_text(nlohmann::json(row).dump());
  row.study = study;
  row.utc = utc_now();
  return row;
}

nlohmann::json provenance() {
  nlohmann::json here = describe_environment("");
  for (const char* of_a_study : {"schema", "kind", "study", "environment", "binding", "counters"})
    here.erase(of_a_study);
  return here;
}

}  // namespace pairsum::harness
