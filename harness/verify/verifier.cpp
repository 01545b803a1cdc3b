#include "harness/verify/verifier.hpp"

#include <algorithm>

#include <pairsum/core/error.hpp>
#include <pairsum/core/random.hpp>
#include "harness/ranks/crew.hpp"
#include "harness/verify/pack.hpp"

namespace pairsum::harness {
namespace {

/// Before verdicts that the first rank has from a store.
const std::string kept_word = "kept ";

/// The expectation as if it were a backend's result, for checking one reference against another.
rate_table as_rates(const expectation& e, std::size_t rows) {
  rate_table t{e.names, std::vector<std::vector<double>>(e.names.size(), std::vector<double>(rows))};
  for (std::size_t c = 0; c < e.names.size(); ++c)
    for (std::size_t k = 0; k < e.ids.size(); ++k) t.columns[c][e.ids[k]] = e.value[c][k];
  return t;
}

}  // namespace

verifier::verifier(const registry& r, const setup& s, const particle_table& initial, const team& t, shared_store* store,
                   std::string key)
    : reference_(r.make_reference(s)), store_(store), key_(std::move(key)) {
  const auto verdicts =
      store_ == nullptr ? std::nullopt : store_->load(key_ + "/verdicts");  // saved after the reference
  if (const std::string kept = here().told(verdicts ? kept_word + *verdicts : ""); !kept.empty()) {
    known_ = unpack_verdicts(kept.substr(kept_word.size()));
    return;
  }
  if (!here().is_first()) return;
  expected_ = reference_of(initial, t);
  if (store_ == nullptr) return;
  store_->save(key_ + "/reference", pack(*expected_));
  remember();
}

expectation verifier::reference_of(const particle_table& initial, const team& t) const {
  if (initial.size() <= brute_force_limit) return reference_->brute_force(initial, t);
  expectation e = reference_->cell_search(initial, t);
  const verdict self = compare(as_rates(e, initial.size()), sampled(initial, 1000, 0, t));
  if (!self.ok) throw error("the reference contradicts brute force: " + self.error);
  return e;
}

const expectation& verifier::initial_expectation() {
  if (!expected_) {
    const auto bytes = store_->load(key_ + "/reference");
    if (!bytes) throw error("the store that the processes of a study share has lost the reference");
    expected_ = unpack_expectation(*bytes);
  }
  return *expected_;
}

void verifier::remember() {
  if (store_ != nullptr) store_->save(key_ + "/verdicts", pack(known_));
}

expectation verifier::sampled(const particle_table& p, std::size_t n, std::uint64_t seed, const team& t) const {
  std::vector<std::uint32_t> fluid, chosen;
  for (std::uint32_t i = 0; i < p.size(); ++i)
    if (p.kind[i] == particle_kind::fluid) fluid.push_back(i);
  const counter_random random(seed, 5);
  for (std::size_t k = 0; k < n && !fluid.empty(); ++k) chosen.push_back(fluid[random.bits(k) % fluid.size()]);
  if (chosen.empty()) return reference_->brute_force(particle_table(p.dim), t);
  return reference_->brute_force(p, t, chosen);
}

expectation verifier::expect_now(const particle_table& p, int evaluation, const team& t) const {
  if (p.size() <= brute_force_limit) return reference_->brute_force(p, t);
  return sampled(p, later_samples, static_cast<std::uint64_t>(evaluation), t);
}

verdict verifier::judge(summation& s, const moment& when, const team& t) {
  const rate_table rates = s.rates();
  const particle_table now = when.evaluation == 1 ? particle_table(1) : s.snapshot();
  verdict v;
  if (here().is_first())
    v = compare(rates, when.evaluation == 1 ? initial_expectation() : expect_now(now, when.evaluation, t));
  return here().size() == 1 ? v : unpack_verdict(here().told(pack(v)));
}

verifier::outcome verifier::check(summation& s, const moment& when, const team& t) {
  outcome o;
  o.fingerprint = s.fingerprint();
  const auto seen = known_.find({when, o.fingerprint});
  o.known = seen != known_.end();
  const verdict v = o.known ? seen->second : judge(s, when, t);
  o.ok = v.ok;
  o.finite = v.finite;
  o.max_rel_err = v.max_rel_err;
  o.bound = v.bound;
  o.error = v.error;
  if (v.ok) known_.insert({{when, o.fingerprint}, v});
  return o;
}

}  // namespace pairsum::harness
