#include "harness/rows/row.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/rows/fields.hpp"
#include "harness/rows/json_parts.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

/// To a tenth of a microsecond, the resolution of a clock around a pass.
json pass_times(const std::optional<thread_times>& times) {
  if (!times) return nullptr;
  json passes = json::array();
  for (const std::vector<double>& pass : *times) {
    json threads = json::array();
    for (const double s : pass) {
      if (!std::isfinite(s)) return nullptr;
      threads.push_back(std::round(s * 1e7) / 1e7);
    }
    passes.push_back(threads);
  }
  return passes;
}

point read_point(fields from, bool former) {
  point p;
  p.case_name = from.text("case");
  p.state = from.text("state");
  p.dx = from.number("dx");
  p.H = from.number("H");
  p.n_fluid = from.count("n_fluid");
  p.n_boundary = from.count("n_boundary");
  p.order = from.text("order");
  p.dim = from.integer("dim", 1);
  p.precision = from.text("precision");
  p.interaction = from.text("interaction");
  p.smoothing = from.text("smoothing");
  p.integrator = from.text("integrator");
  p.dt = from.number("dt");
  p.backend = from.text("backend");
  p.grid = from.text("grid");
  p.M = from.is_null("M") ? 0 : from.integer("M", 1);
  p.threads = from.integer("threads", 1);
  p.granularity = from.text("granularity");
  p.isa = from.text("isa");
  p.ranks = from.has("ranks") ? from.integer("ranks", 1) : 1;
  if (from.has("cut") && !from.is_null("cut")) p.cut = from.word("cut", {"twice", "once"});
  if (from.has("particles")) p.particles = from.hex("particles");
  if (!former || from.has("block")) p.block = from.text("block");  // older rows have none
  from.finish();
  return p;
}

phases read_phases(fields from) {
  phases p;
  for (const phase_member& phase : phase_members) p.*phase.value = from.amount_or_null(phase.name);
  from.finish();
  return p;
}

struct work_member {
  const char* name;
  std::uint64_t work_row::*value;
};

constexpr work_member work_members[] = {{"cells", &work_row::cells},
                                        {"cells_nonempty", &work_row::cells_nonempty},
                                        {"sumF1", &work_row::sumF1},
                                        {"sumF2", &work_row::sumF2},
                                        {"pairs_tested", &work_row::pairs_tested},
                                        {"pairs_interacting", &work_row::pairs_interacting},
                                        {"pairs_fluid_fluid", &work_row::pairs_fluid_fluid},
                                        {"pairs_fluid_boundary", &work_row::pairs_fluid_boundary}};

work_row read_work(fields from, bool former) {
  work_row w;
  for (const work_member& member : work_members) w.*member.value = from.count(member.name);
  w.pairs_tested_unfolded = from.count_or_null("pairs_tested_unfolded");
  if (from.has("vector_units")) {
    fields units = from.nested("vector_units");
    w.vector_units = {units.text("block"), units.count("lanes"), units.count("vectors"), units.number("occupancy")};
    units.finish();
  }
  if (!former) {
    w.flops = from.amount_or_null("flops");
    w.bytes = from.amount_or_null("bytes");
  }
  from.finish();
  return w;
}

counters_row read_counters(fields from) {
  counters_row c;
  c.cycles = from.count_or_null("cycles");
  c.instructions = from.count_or_null("instructions");
  c.cache_misses = from.count_or_null("cache_misses");
  from.finish();
  return c;
}

verify_row read_verify(fields from) {
  verify_row v;
  v.max_rel_err = from.number_or_null("max_rel_err");
  v.bound = from.number_or_null("bound");
  v.fingerprint = from.hex_or_null("fingerprint");
  from.finish();
  return v;
}

template <class T, class Read>
std::optional<T> read_or_null(fields& from, const char* key, Read read) {
  if (from.is_null(key)) return std::nullopt;
  return read(from.nested(key));
}

}  // namespace

void to_json(json& j, const point& p) {
  j = {{"case", p.case_name},
       {"state", p.state},
       {"dx", finite(p.dx)},
       {"H", finite(p.H)},
       {"n_fluid", p.n_fluid},
       {"n_boundary", p.n_boundary},
       {"order", p.order},
       {"dim", p.dim},
       {"precision", p.precision},
       {"interaction", p.interaction},
       {"smoothing", p.smoothing},
       {"integrator", p.integrator},
       {"dt", finite(p.dt)},
       {"backend", p.backend},
       {"grid", p.grid},
       {"M", p.M > 0 ? json(p.M) : json(nullptr)},
       {"threads", p.threads},
       {"granularity", p.granularity},
       {"isa", p.isa},
       {"block", p.block}};
  j["ranks"] = p.ranks;
  if (p.ranks > 1) j["cut"] = p.cut;
  if (!p.particles.empty()) j["particles"] = p.particles;
}

void to_json(json& j, const phases& p) {
  j = json::object();
  for (const phase_member& phase : phase_members) j[phase.name] = finite(p.*phase.value);
}

void to_json(json& j, const vector_use& v) {
  j = {{"block", v.block}, {"lanes", v.lanes}, {"vectors", v.vectors}, {"occupancy", finite(v.occupancy)}};
}

void to_json(json& j, const work_row& w) {
  j = json::object();
  for (const work_member& member : work_members) j[member.name] = w.*member.value;
  j["pairs_tested_unfolded"] = or_null(w.pairs_tested_unfolded);
  if (w.vector_units) j["vector_units"] = *w.vector_units;
  j["flops"] = finite(w.flops);
  j["bytes"] = finite(w.bytes);
}

void to_json(json& j, const counters_row& c) {
  j = {{"cycles", or_null(c.cycles)},
       {"instructions", or_null(c.instructions)},
       {"cache_misses", or_null(c.cache_misses)}};
}

void to_json(json& j, const verify_row& v) {
  j = {{"max_rel_err", finite(v.max_rel_err)}, {"bound", finite(v.bound)}, {"fingerprint", or_null(v.fingerprint)}};
}

void to_json(json& j, const sample& s) {
  j = head("sample", s);
  j["part"] = s.part;
  j["round"] = s.round;
  j["slot"] = s.slot;
  j["repetition"] = s.repetition;
  j["step"] = s.step;
  j["seed"] = s.seed;
  j["point"] = s.point;
  j["phases"] = or_null(s.phases);
  j["threads_busy_s"] = pass_times(s.threads_busy_s);
  j["barrier_wait_s"] = pass_times(s.barrier_wait_s);
  j["counters"] = or_null(s.counters);
  j["work"] = or_null(s.work);
  j["peak_rss_bytes"] = or_null(s.peak_rss_bytes);
  j["workspace_bytes"] = or_null(s.workspace_bytes);
  j["lost"] = or_null(s.lost);
  j["threads_worked"] = or_null(s.threads_worked);
  j["verify"] = s.verify;
  if (s.ranks) j["ranks"] = *s.ranks;
  if (s.error) j["error"] = *s.error;
  if (s.untimed) j["untimed"] = *s.untimed;
}

void from_json(const json& j, point& p) { p = read_point(fields(j), false); }
void from_json(const json& j, phases& p) { p = read_phases(fields(j)); }
void from_json(const json& j, work_row& w) { w = read_work(fields(j), false); }
void from_json(const json& j, verify_row& v) { v = read_verify(fields(j)); }

void from_json(const json& j, sample& s) {
  fields from(j);
  const bool former = read_head(from, "sample", s);
  s.part = from.text("part");
  s.round = from.integer("round", 1);
  s.slot = from.integer("slot", 1);
  s.repetition = from.integer("repetition", 1);
  s.step = from.integer("step", 1);
  s.seed = from.count("seed");
  s.point = read_point(from.nested("point"), former);
  s.error.reset();
  if (from.has("error")) s.error = from.text("error");
  s.phases = read_or_null<phases>(from, "phases", read_phases);
  s.untimed.reset();
  if (from.has("untimed")) s.untimed = from.text("untimed");
  if (s.phases && s.error) from.reject("phases", "null in a row with \"error\"");
  if (s.phases && s.untimed) from.reject("phases", "null in a row with \"untimed\"");
  if (!s.phases && !s.error && !s.untimed) from.reject("phases", "an object in a row without \"error\"");
  s.threads_busy_s = from.seconds_table_or_null("threads_busy_s");
  s.barrier_wait_s = from.seconds_table_or_null("barrier_wait_s");
  s.counters = read_or_null<counters_row>(from, "counters", read_counters);
  s.work = read_or_null<work_row>(from, "work", [former](const fields& work) { return read_work(work, former); });
  s.peak_rss_bytes = from.count_or_null("peak_rss_bytes");
  s.workspace_bytes = s.lost = s.threads_worked = std::nullopt;
  if (!former || from.has("workspace_bytes")) s.workspace_bytes = from.count_or_null("workspace_bytes");
  if (!former) {
    s.lost = from.count_or_null("lost");
    s.threads_worked = from.count_or_null("threads_worked");
  }
  s.ranks.reset();
  if (from.has("ranks")) s.ranks = read_ranks(from, "ranks");
  if (s.ranks && s.ranks->size() < 2) from.reject("ranks", "a list of at least 2 ranks");
  s.verify = read_verify(from.nested("verify"));
  from.finish();
}

std::string format_row(const row& value) {
  json j;
  std::visit([&j](const auto& v) { to_json(j, v); }, value);
  return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

row parse_row(const json& j) {
  fields from(j);
  from.word("schema", {row_schema, former_row_schema});
  const std::string kind =
      from.word("kind", {"sample", "environment", "backend", "peak", "pace", "round", "end", "void", "particles"});
  if (kind == "sample") return j.get<sample>();
  if (kind == "environment") return j.get<environment_row>();
  if (kind == "backend") return j.get<backend_row>();
  if (kind == "peak") return j.get<peak_row>();
  if (kind == "pace") return j.get<pace_row>();
  if (kind == "round") return j.get<round_row>();
  if (kind == "end") return j.get<end_row>();
  if (kind == "particles") return j.get<particles_row>();
  return j.get<void_row>();
}

}  // namespace pairsum::harness
