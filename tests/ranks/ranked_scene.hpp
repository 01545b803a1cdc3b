#pragma once
#include "scene.hpp"

#include <pairsum/ranks/job.hpp>
#include <pairsum/ranks/ranked.hpp>

/// What the tests of ranks share. Every rank runs every test, in the same order, as sums are collective.
namespace pairsum::test_kit {

/// The job of this process; made by main().
const ranks::job& this_job();

/// A summation over all ranks.
inline std::unique_ptr<summation> ranked(const setup& s, const ranks::options& o) {
  return ranks::make_ranked(registry::instance().make_summation(s), o);
}

}  // namespace pairsum::test_kit
