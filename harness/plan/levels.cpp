#include "harness/plan/levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include <pairsum/core/isa.hpp>
#include "harness/environment/machine.hpp"
#include "harness/plan/variants.hpp"
#include "harness/plan/words.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// A number, a text or a list of them as the text that the command line would take.
std::string joined(const std::string& key, const json& value) {
  const auto scalar = [&](const json& v) {
    if (v.is_string()) return v.get<std::string>();
    if (v.is_number()) return v.dump();
    throw error(
        fmt::format("the plan's \"{}\" should be a number, a text or a list of them, is {}", key, value.dump()));
  };
  if (!value.is_array()) return scalar(value);
  std::string text;
  for (const json& v : value) text += (text.empty() ? "" : ",") + scalar(v);
  return text;
}

struct level {
  std::function<void(run_request&, const std::string& key, const std::string& text, int cores)> read;
  std::function<json(const run_request&)> write;
};

level words(std::vector<std::string> run_request::*member) {
  return {[member](run_request& r, const std::string& key, const std::string& text, int) {
            r.*member = parse_words(key, text);
          },
          [member](const run_request& r) { return json(r.*member); }};
}
/// Instruction sets; "all" is scalar and every one that build and machine have.
level isas() {
  level one = words(&run_request::isas);
  one.read = [read = one.read](run_request& r, const std::string& key, const std::string& text, int cores) {
    read(r, key, text, cores);
    if (r.isas != std::vector<std::string>{"all"}) return;
    r.isas = {std::string(scalar_isa)};
    for (const std::string_view isa : isa_names()) r.isas.emplace_back(isa);
  };
  return one;
}
/// Backends; "all" is every one that this build has.
level backends() {
  level one = words(&run_request::backends);
  one.read = [read = one.read](run_request& r, const std::string& key, const std::string& text, int cores) {
    read(r, key, text, cores);
    if (r.backends == std::vector<std::string>{"all"}) r.backends = available_backends();
  };
  return one;
}
level word(std::string run_request::*member) {
  return {[member](run_request& r, const std::string&, const std::string& text, int) { r.*member = text; },
          [member](const run_request& r) { return json(r.*member); }};
}
level counts(std::vector<int> run_request::*member) {
  return {[member](run_request& r, const std::string& key, const std::string& text, int) {
            r.*member = parse_counts(key, text, 0);
          },
          [member](const run_request& r) { return json(r.*member); }};
}
/// Numbers of threads; "cores/ranks" is a number of all ranks together, "8/ranks".
level threads() {
  constexpr std::string_view shared = "/ranks";
  const auto write = [shared](const run_request& r) {
    json all = r.threads;
    for (const int t : r.shared_threads) all.push_back(std::to_string(t) + std::string(shared));
    return all;
  };
  return {[shared](run_request& r, const std::string& key, const std::string& text, int cores) {
            std::string each, together;
            for (const std::string& word : parse_words(key, text)) {
              const bool is_shared = word.ends_with(shared);
              if (word == shared)
                throw error(fmt::format("{} takes words like 1 or cores/ranks, not \"{}\"", key, word));
              std::string& list = is_shared ? together : each;
              list += (list.empty() ? "" : ",") + word.substr(0, word.size() - (is_shared ? shared.size() : 0));
            }
            r.threads = each.empty() ? std::vector<int>{} : parse_counts(key, each, cores);
            r.shared_threads = together.empty() ? std::vector<int>{} : parse_counts(key, together, cores * job_nodes());
          },
          write};
}
/// The only one of them; a list would be cut silently.
template <class N>
N single(const std::string& key, const std::string& text, const std::vector<N>& values) {
  if (values.size() != 1) throw error(fmt::format("{} takes one number, not \"{}\"", key, text));
  return values.front();
}

level count(int run_request::*member) {
  return {[member](run_request& r, const std::string& key, const std::string& text, int) {
            r.*member = single(key, text, parse_counts(key, text, 0));
          },
          [member](const run_request& r) { return json(r.*member); }};
}
level number(double run_request::*member) {
  return {[member](run_request& r, const std::string& key, const std::string& text, int) {
            r.*member = single(key, text, parse_numbers(key, text));
          },
          [member](const run_request& r) { return json(r.*member); }};
}

/// What particle files do not say, as it was given; checked where they are read.
level hint(const std::string& word) {
  return {[word](run_request& r, const std::string&, const std::string& text, int) {
            if (text.empty())
              r.hints.erase(word);
            else
              r.hints[word] = text;
          },
          [word](const run_request& r) {
            const auto at = r.hints.find(word);
            return at == r.hints.end() ? json() : json(at->second);
          }};
}
level particle_files() {
  return {[](run_request& r, const std::string& key, const std::string& text, int) {
            r.particles = text.empty() ? std::vector<std::string>{} : parse_words(key, text);
          },
          [](const run_request& r) { return r.particles.empty() ? json() : json(r.particles); }};
}

std::map<std::string, level> all_levels() {
  using r = run_request;
  std::map<std::string, level> all{
      {"case", word(&r::case_name)},
      {"dx",
       {[](r& q, const std::string& key, const std::string& text, int) { q.dx = parse_numbers(key, text); },
        [](const r& q) { return json(q.dx); }}},
      {"state", words(&r::states)},
      {"backend", backends()},
      {"M", counts(&r::M)},
      {"threads", threads()},
      {"ranks", counts(&r::ranks)},
      {"cut", words(&r::cuts)},
      {"dim", count(&r::dim)},
      {"H", number(&r::H)},
      {"order", words(&r::orders)},
      {"precision", words(&r::precisions)},
      {"interaction", words(&r::interactions)},
      {"smoothing", words(&r::smoothings)},
      {"integrator", words(&r::integrators)},
      {"granularity", words(&r::granularities)},
      {"grid", words(&r::grids)},
      {"isa", isas()},
      {"block", words(&r::blocks)},
      {"outside", word(&r::outside)},
      {"dt", number(&r::dt)},
      {"steps", count(&r::steps)},
      {"repetitions", count(&r::repetitions)},
      {"seed",
       {[](r& q, const std::string& key, const std::string& text, int) { q.seed = parse_seed(key, text); },
        [](const r& q) { return json(q.seed); }}},
      {"particles", particle_files()},
      {"particles_hash",
       {[](r& q, const std::string&, const std::string& text, int) { q.particles_hash = text; },
        [](const r& q) { return q.particles_hash.empty() ? json() : json(q.particles_hash); }}},
  };
  for (const particle_hint& h : particle_hints()) all.emplace(h.word, hint(std::string(h.word)));
  return all;
}

const std::map<std::string, level>& levels() {
  static const std::map<std::string, level> all = all_levels();
  return all;
}

}  // namespace

bool read_level(run_request& r, const std::string& key, const json& value, int cores, const std::string& called) {
  const auto at = levels().find(key);
  if (at == levels().end()) return false;
  at->second.read(r, called.empty() ? fmt::format("the plan's \"{}\"", key) : called, joined(key, value), cores);
  return true;
}

json levels_json(const run_request& r) {
  json j = json::object();
  for (const auto& [key, level] : levels())
    if (json value = level.write(r); !value.is_null()) j[key] = std::move(value);
  return j;
}

const std::vector<particle_hint>& particle_hints() {
  static const std::vector<particle_hint> all{
      {"h", "smoothing length in m; H is --support times it"},
      {"support", "support radius in smoothing lengths [what the format says, else 2]"},
      {"h_quantile", "of an h that varies, the share of particles whose h is no larger [1]"},
      {"rho0", "density at rest in kg/m3"},
      {"mass", "of a particle in kg"},
      {"B", "of the equation of state, in Pa"},
      {"boundary_kind", "which particles are boundary: Type=0,1, or none"},
      {"periodic", "axes: x,z, all or none"},
      {"box", "edges of a box at 0, or its corners, in m: 1,1,1 or 0,0,0,1,1,1"},
      {"column", "a column of another name: x=Points:0,rho=Density"},
      {"file_dim", "dimension, where the files' own is not wanted"},
      {"file_step", "of a file with several steps [the last]"},
  };
  return all;
}

std::string option_of(std::string_view level) {
  std::string option = "--" + std::string(level);
  std::ranges::replace(option, '_', '-');
  return option;
}

std::vector<std::string> level_words() {
  std::vector<std::string> words;
  for (const auto& [key, level] : levels()) words.push_back(key);
  return words;
}

}  // namespace pairsum::harness
