// Runs one OpenMP backend for the race detector to watch. Exit status: 0, 2 for bad use, the
// detector's own if it reports a race.
//
//   race_main --list            starts the threads, names the library's OpenMP backends, then the
//   planted ones race_main --backend NAME    a backend of the library race_main --planted NAME    a
//   backend with a race on purpose
#include <omp.h>

#include <cstdio>
#include <string>

#include "core/error.hpp"
#include "core/names.hpp"
#include "trial.hpp"

namespace pairsum::races {
namespace {

constexpr int threads = 4;

const contender& find(const std::vector<contender>& all, std::string_view name) {
  std::vector<std::string_view> names;
  for (const contender& c : all) {
    if (c.name == name) return c;
    names.push_back(c.name);
  }
  throw unknown_name("backend", name, names);
}

/// Fewer threads than asked for would find fewer races, or none.
void require_threads() {
  int got = 0;
#pragma omp parallel num_threads(threads)
  {
#pragma omp master
    got = omp_get_num_threads();
  }
  if (got != threads)
    throw error("OpenMP grants " + std::to_string(got) + " threads instead of " + std::to_string(threads) +
                "; unset OMP_THREAD_LIMIT and OMP_DYNAMIC");
}

int list() {
  require_threads();
  for (const contender& c : library_backends()) std::printf("%s\n", c.name.data());
  for (const contender& c : planted_backends()) std::printf("planted %s\n", c.name.data());
  return 0;
}

int run_all(const contender& c, const std::vector<trial>& trials) {
  require_threads();
  for (const trial& w : trials) run(c, w, threads);
  std::printf("race_main: %s done\n", c.name.data());
  return 0;
}

int main_of(int argc, char** argv) {
  const std::string_view mode = argc > 1 ? argv[1] : "", name = argc > 2 ? argv[2] : "";
  if (mode == "--list" && argc == 2) return list();
  if (mode == "--backend" && argc == 3) return run_all(find(library_backends(), name), all_trials);
  if (mode == "--planted" && argc == 3) return run_all(find(planted_backends(), name), planted_trials);
  throw error("usage: race_main --list | --backend NAME | --planted NAME");
}

}  // namespace
}  // namespace pairsum::races

int main(int argc, char** argv) try { return pairsum::races::main_of(argc, argv); } catch (const std::exception& e) {
  std::fprintf(stderr, "race_main: %s\n", e.what());
  return 2;
}
