/// read_files [--OPTION=VALUE]... PATH...: reads files as one set, prints it as JSON, and with --out=PATH writes it.
/// Exits 2 with one line on what is wrong.
#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include <pairsum/core/error.hpp>
#include <pairsum/files/read_particles.hpp>
#include <pairsum/files/words.hpp>
#include <pairsum/files/write_hdf.hpp>

using namespace pairsum;
using namespace pairsum::files;

int main(int argc, char** argv) {
  hints told;
  std::string out, xmf;
  std::vector<std::string> paths;
  const auto number = [](std::optional<double>& to) { return [&to](const std::string& v) { to = std::stod(v); }; };
  const std::map<std::string, std::function<void(const std::string&)>> options{
      {"H", number(told.H)},
      {"h", number(told.h)},
      {"rho0", number(told.rho0)},
      {"mass", number(told.mass)},
      {"support", number(told.support)},
      {"h-quantile", number(told.h_quantile)},
      {"dim", [&](const std::string& v) { told.dim = std::stoi(v); }},
      {"step", [&](const std::string& v) { told.step = std::stoll(v); }},
      {"boundary-kind", [&](const std::string& v) { told.boundary_kind = v; }},
      {"periodic", [&](const std::string& v) { told.periodic = v; }},
      {"box",
       [&](const std::string& v) {
         for (const auto w : split(v, ',')) told.box.push_back(*number_in(w));
       }},
      {"column", [&](const std::string& v) { told.columns[v.substr(0, v.find('='))] = v.substr(v.find('=') + 1); }},
      {"out", [&](const std::string& v) { out = v; }},
      {"xmf", [&](const std::string& v) { xmf = v; }}};
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const std::size_t equals = word.find('=');
    if (word.starts_with("--"))
      options.at(word.substr(2, equals - 2))(word.substr(equals + 1));
    else
      paths.push_back(word);
  }
  try {
    const read_set set = read_particles(paths, told);
    nlohmann::json facts;
    constexpr const char* words[]{"read", "given", "derived", "assumed"};
    for (const fact& f : set.facts)
      facts.push_back(
          {{"what", f.what}, {"value", f.value}, {"how", words[static_cast<int>(f.how)]}, {"from", f.from}});
    const initial_condition& c = set.initial;
    const nlohmann::json j{{"facts", facts},
                           {"hash", set.hash},
                           {"dx", set.dx},
                           {"wrapped", set.wrapped},
                           {"time", set.time},
                           {"dim", c.particles.dim},
                           {"H", c.H},
                           {"rho0", c.eos.rho0},
                           {"B", c.eos.B},
                           {"gravity", c.gravity},
                           {"particles", c.particles.size()},
                           {"fluid", c.particles.count(particle_kind::fluid)},
                           {"low", c.omega_low},
                           {"high", c.omega_high},
                           {"periodic", c.periodic.any()}};
    std::puts(j.dump().c_str());
    if (!out.empty()) write_hdf(out, c, {.time = set.time, .step = 7, .dx = set.dx, .facts = set.facts});
    if (!xmf.empty()) write_xmf(xmf, {{out, 0, c.particles.size()}, {out, 1, c.particles.size()}});
  } catch (const error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
