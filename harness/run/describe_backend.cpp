#include "harness/run/describe_backend.hpp"

#include "harness/self_test/entries.hpp"

namespace pairsum::harness {

backend_row describe_backend(const backend_traits& b) {
  backend_row row;
  row.name = b.name;
  row.description = b.description;
  row.aliases = b.aliases;
  row.runtime = name_of(b.threads);
  row.conflicts = name_of(b.conflicts);
  row.symmetric = b.symmetric;
  row.deterministic = b.deterministic;
  row.vector = b.vector;
  row.blocks = b.blocks;
  for (const self_test_entry& e : self_test_entries())
    if (e.word == b.name) row.self_test = {std::string(e.what), std::string(e.base), e.expected_ratio()};
  return row;
}

}  // namespace pairsum::harness
