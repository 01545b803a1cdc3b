// Questions as JSON lines in, what the statistics say as JSON lines out: for test_scipy.py.
#include <iostream>
#include <nlohmann/json.hpp>

#include "harness/stats/holm.hpp"

namespace {

using namespace pairsum::harness;
using nlohmann::json;

json ends(const std::optional<interval>& i) { return i ? json{i->low, i->high, i->confidence} : json(); }

json answer(const json& q) {
  const auto values = [&](const char* key) { return q.at(key).get<std::vector<double>>(); };
  const double level = q.value("level", 0.95);
  const std::string what = q.at("what");
  if (what == "median") return {{"value", median(values("of"))}, {"ends", ends(median_interval(values("of"), level))}};
  if (what == "holm") return holm_adjusted(values("of"));
  if (what == "quantile") return student_t_quantile(q.at("of"), q.at("freedom"));
  if (what == "tails") return student_t_two_sided(q.at("of"), q.at("freedom"));
  const ratio_estimate r = paired_ratio(values("base"), values("other"), level);
  if (what == "verdict") return word_of(verdicts_of({{r}}).at(0));
  return {
      {"value", r.value}, {"ends", ends(r.bounds)}, {"pairs", r.pairs}, {"p", r.p_value ? json(*r.p_value) : json()}};
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    json said;
    try {
      said = answer(json::parse(line));
    } catch (const pairsum::error& e) {
      said = {{"error", e.what()}};
    }
    std::cout << said << "\n";
  }
}
