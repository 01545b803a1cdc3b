#include "harness/self_test/self_test.hpp"

#include <algorithm>

#include <pairsum/core/error.hpp>
#include "harness/self_test/corrupt_summation.hpp"
#include "harness/self_test/slowed_summation.hpp"

namespace pairsum::harness {
namespace {

std::unique_ptr<summation> wrap(std::unique_ptr<summation> inner, const setup& s) {
  const auto e = std::ranges::find(self_test_entries(), std::string_view(s.backend), &self_test_entry::word);
  if (e == self_test_entries().end()) throw error("no self-test is called " + s.backend);
  switch (e->kind) {
    case self_test_kind::slowed:
      return std::make_unique<slowed_summation>(std::move(inner), e->word, e->description, e->delay);
    case self_test_kind::corrupt:
      return std::make_unique<corrupt_summation>(std::move(inner), e->word, e->description);
    case self_test_kind::again:
      break;
  }
  return std::make_unique<forwarding_summation>(std::move(inner), e->word, e->description);
}

}  // namespace

registry with_self_test(const registry& base) {
  registry extended = base;
  for (const self_test_entry& e : self_test_entries()) {
    const auto original = std::ranges::find(base.backends(), e.base, [](const auto& b) { return b.traits.name; });
    if (original == base.backends().end() || !original->unavailable.empty()) continue;
    backend_traits traits = original->traits;
    traits.name = e.word;
    traits.description = e.description;
    extended.add_wrapper(traits, std::string(e.base), wrap);
  }
  return extended;
}

}  // namespace pairsum::harness
