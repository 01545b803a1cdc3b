// The ranks of a sample.
#include <utility>

#include "harness/rows/json_parts.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

constexpr std::pair<const char*, std::uint64_t rank_row::*> rank_counts[] = {{"own", &rank_row::own},
                                                                             {"ghosts", &rank_row::ghosts},
                                                                             {"boundary", &rank_row::boundary},
                                                                             {"pairs", &rank_row::pairs},
                                                                             {"cut", &rank_row::cut}};
constexpr std::pair<const char*, traffic_row rank_row::*> rank_traffic[] = {{"halo", &rank_row::halo},
                                                                            {"migrate", &rank_row::migrate},
                                                                            {"send_back", &rank_row::send_back},
                                                                            {"partition", &rank_row::partition}};

rank_row read_rank(fields from) {
  rank_row r;
  r.host = from.text("host");
  r.cores = from.text("cores");
  for (const auto& [key, member] : rank_counts) r.*member = from.count(key);
  r.busy_s = from.amount_or_null("busy_s");
  r.waiting_s = from.amount_or_null("waiting_s");
  for (const auto& [key, member] : rank_traffic) {
    fields sent = from.nested(key);
    r.*member = {sent.count("messages"), sent.count("bytes")};
    sent.finish();
  }
  from.finish();
  return r;
}

}  // namespace

void to_json(json& j, const rank_row& r) {
  j = {{"host", r.host}, {"cores", r.cores}, {"busy_s", finite(r.busy_s)}, {"waiting_s", finite(r.waiting_s)}};
  for (const auto& [key, member] : rank_counts) j[key] = r.*member;
  for (const auto& [key, member] : rank_traffic)
    j[key] = {{"messages", (r.*member).messages}, {"bytes", (r.*member).bytes}};
}

std::vector<rank_row> read_ranks(fields& from, const char* key) {
  std::vector<rank_row> ranks;
  for (const fields& one : from.objects(key)) ranks.push_back(read_rank(one));
  return ranks;
}

}  // namespace pairsum::harness
