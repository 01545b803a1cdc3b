#include "harness/run/order.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

constexpr const char* order_schema = "pairsum.order/5";
constexpr const char* errands[] = {"peaks", "verify", "measure"};

}  // namespace

nlohmann::json order_json(const order& o) {
  return {{"schema", order_schema},
          {"what", errands[static_cast<int>(o.what)]},
          {"plan", plan_json(o.plan)},
          {"part", o.part},
          {"round", o.round},
          {"out", o.out},
          {"environments", o.known.environments},
          {"backends", o.known.backends},
          {"particles", o.known.particles},
          {"binding", o.binding},
          {"store", o.store},
          {"store_path", o.store_path},
          {"store_host", o.store_host},
          {"ranks", o.ranks},
          {"crowded", o.crowded},
          {"standing",
           {{"elapsed_s", o.where.elapsed_s},
            {"done_s", o.where.done_s},
            {"this_s", o.where.this_s},
            {"all_s", o.where.all_s},
            {"shown", o.where.shown},
            {"text", o.where.text}}}};
}

order parse_order(const nlohmann::json& j) {
  const auto other_version = [] {
    return error(std::string("a worker takes orders of schema \"") + order_schema +
                 "\" from the program that conducts the study, which is another version");
  };
  if (!j.is_object() || j.value("schema", nlohmann::json()) != order_schema) throw other_version();
  order o;
  const auto what = std::ranges::find(errands, j.at("what"));
  if (what == std::end(errands)) throw other_version();
  o.what = static_cast<errand>(what - errands);
  o.plan = parse_plan(j.at("plan"), 1);
  o.part = j.at("part");
  if (o.part >= o.plan.parts.size()) throw other_version();
  o.round = j.at("round");
  o.out = j.at("out");
  o.known.environments = j.at("environments").get<std::set<std::string>>();
  o.known.backends = j.at("backends").get<std::set<std::pair<std::string, std::string>>>();
  o.known.particles = j.at("particles").get<std::set<std::string>>();
  o.binding = j.at("binding");
  o.store = j.at("store");
  o.store_path = j.at("store_path");
  o.store_host = j.at("store_host");
  o.ranks = j.at("ranks");
  o.crowded = j.at("crowded");
  const auto& where = j.at("standing");
  o.where = {where.at("elapsed_s"), where.at("done_s"),        where.at("this_s"),
             where.at("all_s"),     where.value("shown", 0.0), where.at("text")};
  return o;
}

}  // namespace pairsum::harness
