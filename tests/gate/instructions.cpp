// One sum of every backend, scalar and on vector units, on one thread, for callgrind to count: the counts of each are
// dumped under "<backend> <isa>".
//
//   valgrind --tool=callgrind --collect-atstart=no instructions
#include <valgrind/callgrind.h>

#include <cstdio>
#include <list>
#include <string>

#include <pairsum/core/isa.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/registry.hpp>
#include <pairsum/sum/setup_of.hpp>

namespace pairsum {
namespace {

void count(const backend_entry& b, const std::string& isa, const initial_condition& start) {
  setup s = setup_of(start);
  s.backend = b.traits.name;
  s.isa = isa;
  s.M = 4;
  s.cores = 2;
  s.cache_bytes = std::size_t{1} << 20;
  const auto sum = registry::instance().make_summation(s);
  const workers one(b.traits.threads, 1);
  sum->load(start.particles, {});
  sum->evaluate(one.get());  // what is made at the first time is no part of a sum
  sum->zero(one.get());
  CALLGRIND_ZERO_STATS;
  CALLGRIND_TOGGLE_COLLECT;
  sum->sum(one.get());
  CALLGRIND_TOGGLE_COLLECT;
  static std::list<std::string> names;  // callgrind reads them later
  names.push_back(std::string(b.traits.name) + " " + std::string(sum->isa()));
  CALLGRIND_DUMP_STATS_AT(names.back().c_str());
}

int main_of() {
  const initial_condition start = make_case("dam_break", {.dim = 3, .dx = 0.06, .state = "perturbed"});
  for (const backend_entry& b : registry::instance().backends()) {
    count(b, std::string(scalar_isa), start);
    if (b.traits.conflicts != conflict_avoidance::atomics) count(b, std::string(best_isa), start);
  }
  return 0;
}

}  // namespace
}  // namespace pairsum

int main() try { return pairsum::main_of(); } catch (const std::exception& e) {
  std::fprintf(stderr, "instructions: %s\n", e.what());
  return 2;
}
