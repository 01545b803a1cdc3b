#include "harness/run/step_of_ranks.hpp"

#include <algorithm>

namespace pairsum::harness {
namespace {

void add_to(traffic_row& a, const ranks::traffic& b) {
  a.messages += b.messages;
  a.bytes += b.bytes;
}

/// The numbers of all ranks; empty where a rank has none.
std::vector<double> of_ranks(const std::optional<std::uint64_t>& own) {
  const double number = own ? static_cast<double>(*own) : -1;
  std::vector<double> all;
  for (const auto& one : here().gather(std::vector<double>{number})) all.push_back(one.front());
  return std::ranges::any_of(all, [](double n) { return n < 0; }) ? std::vector<double>{} : all;
}

}  // namespace

step_of_ranks::step_of_ranks(const std::vector<rank_seat>& seats, const placement& places, int threads) {
  if (here().size() == 1) return;
  for (std::size_t r = 0; r < seats.size(); ++r) {
    rank_row& one = ranks_.emplace_back();
    one.host = seats[r].host;
    one.cores = units_text(seats[r], places.first[r], threads);
  }
}

void step_of_ranks::add(summation& s, double busy_s, double waiting_s) {
  busy_s_ += busy_s;
  waiting_s_ += waiting_s;
  const std::vector<ranks::rank_facts> facts = here().facts_of(s);
  for (std::size_t r = 0; r < facts.size(); ++r) {
    rank_row& one = ranks_[r];
    one.own = facts[r].own;
    one.ghosts = facts[r].ghosts;
    one.boundary = facts[r].boundary;
    one.pairs = facts[r].pairs;
    one.cut = facts[r].cut;
    add_to(one.halo, facts[r].halo);
    add_to(one.migrate, facts[r].migrate);
    add_to(one.send_back, facts[r].send_back);
    add_to(one.partition, facts[r].partition);
  }
}

std::optional<std::vector<rank_row>> step_of_ranks::end(phases& times) {
  if (ranks_.empty()) return std::nullopt;
  std::vector<double> own{busy_s_, waiting_s_};
  for (const phase_member& phase : phase_members) own.push_back((times.*phase.value).value_or(0));
  const auto all = here().gather(own);
  for (std::size_t r = 0; r < all.size(); ++r) {
    ranks_[r].busy_s = all[r][0];
    ranks_[r].waiting_s = all[r][1];
  }
  for (std::size_t k = 0; k < phase_members.size(); ++k)
    for (const auto& one : all) {
      std::optional<double>& most = times.*phase_members[k].value;
      if (most) most = std::max(*most, one[k + 2]);
    }
  return ranks_;
}

std::optional<std::uint64_t> largest_of_ranks(const std::optional<std::uint64_t>& own) {
  if (here().size() == 1) return own;
  const std::vector<double> all = of_ranks(own);
  return all.empty() ? std::nullopt : std::optional(static_cast<std::uint64_t>(*std::ranges::max_element(all)));
}

std::optional<std::uint64_t> sum_of_ranks(const std::optional<std::uint64_t>& own) {
  if (here().size() == 1) return own;
  double sum = 0;
  const std::vector<double> all = of_ranks(own);
  for (const double n : all) sum += n;
  return all.empty() ? std::nullopt : std::optional(static_cast<std::uint64_t>(sum));
}

std::optional<counters_row> sum_of_ranks(const std::optional<counters_row>& own) {
  counters_row all = own.value_or(counters_row{});
  for (auto* const count : {&all.cycles, &all.instructions, &all.cache_misses}) *count = sum_of_ranks(*count);
  return all.cycles || all.instructions || all.cache_misses ? std::optional(all) : std::nullopt;
}

}  // namespace pairsum::harness
