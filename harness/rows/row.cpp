#include "harness/rows/row.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "harness/rows/fields.hpp"

namespace pairsum::harness {
namespace {

using nlohmann::json;

json finite(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json finite(const std::optional<double>& value) { return value ? finite(*value) : json(nullptr); }

template <class T>
json or_null(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

json finite_list(const std::optional<std::vector<double>>& values) {
  if (!values) return nullptr;
  json list = json::array();
  for (double value : *values) {
    if (!std::isfinite(value)) return nullptr;
    list.push_back(value);
  }
  return list;
}

point read_point(fields from) {
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
  p.M = from.integer("M", 0);
  p.threads = from.integer("threads", 1);
  p.isa = from.text("isa");
  from.finish();
  return p;
}

phases read_phases(fields from) {
  phases p;
  for (const phase_member& phase : phase_members) p.*phase.value = from.seconds_or_null(phase.name);
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

work_row read_work(fields from) {
  work_row w;
  for (const work_member& member : work_members) w.*member.value = from.count(member.name);
  from.finish();
  return w;
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

void read_head(fields& from, const char* kind) {
  from.literal("schema", row_schema);
  from.literal("kind", kind);
}

json head(const char* kind) { return {{"schema", row_schema}, {"kind", kind}}; }

}  // namespace

void to_json(json& j, const point& p) {
  j = {{"case", p.case_name},      {"state", p.state},
       {"dx", finite(p.dx)},       {"H", finite(p.H)},
       {"n_fluid", p.n_fluid},     {"n_boundary", p.n_boundary},
       {"order", p.order},         {"dim", p.dim},
       {"precision", p.precision}, {"interaction", p.interaction},
       {"smoothing", p.smoothing}, {"integrator", p.integrator},
       {"dt", finite(p.dt)},       {"backend", p.backend},
       {"grid", p.grid},           {"M", p.M},
       {"threads", p.threads},     {"isa", p.isa}};
}

void to_json(json& j, const phases& p) {
  j = json::object();
  for (const phase_member& phase : phase_members) j[phase.name] = finite(p.*phase.value);
}

void to_json(json& j, const work_row& w) {
  j = json::object();
  for (const work_member& member : work_members) j[member.name] = w.*member.value;
}

void to_json(json& j, const verify_row& v) {
  j = {{"max_rel_err", finite(v.max_rel_err)}, {"bound", finite(v.bound)}, {"fingerprint", or_null(v.fingerprint)}};
}

void to_json(json& j, const sample& s) {
  j = head("sample");
  j["study"] = s.study;
  j["round"] = s.round;
  j["slot"] = s.slot;
  j["repetition"] = s.repetition;
  j["step"] = s.step;
  j["seed"] = s.seed;
  j["utc"] = s.utc;
  j["environment"] = s.environment;
  j["point"] = s.point;
  j["phases"] = or_null(s.phases);
  j["threads_busy_s"] = finite_list(s.threads_busy_s);
  j["barrier_wait_s"] = finite_list(s.barrier_wait_s);
  j["work"] = or_null(s.work);
  j["peak_rss_bytes"] = or_null(s.peak_rss_bytes);
  j["verify"] = s.verify;
  if (s.error) j["error"] = *s.error;
}

void to_json(json& j, const environment_row& e) {
  j = head("environment");
  j["study"] = e.study;
  j["utc"] = e.utc;
  j["environment"] = e.environment;
  j["host"] = e.host;
  j["cpu"] = e.cpu;
  j["caches"] = e.caches;
  j["cores"] = e.cores;
  j["governor"] = or_null(e.governor);
  j["os_kernel"] = e.os_kernel;
  j["compiler"] = e.compiler;
  j["flags"] = e.flags;
  j["libraries"] = e.libraries;
  j["git"] = e.git;
  j["dirty"] = e.dirty;
  j["binding"] = e.binding;
}

void to_json(json& j, const void_row& v) {
  j = head("void");
  j["study"] = v.study;
  j["utc"] = v.utc;
  j["round"] = v.round;
  j["reason"] = v.reason;
}

void from_json(const json& j, point& p) { p = read_point(fields(j)); }
void from_json(const json& j, phases& p) { p = read_phases(fields(j)); }
void from_json(const json& j, work_row& w) { w = read_work(fields(j)); }
void from_json(const json& j, verify_row& v) { v = read_verify(fields(j)); }

void from_json(const json& j, sample& s) {
  fields from(j);
  read_head(from, "sample");
  s.study = from.text("study");
  s.round = from.integer("round", 1);
  s.slot = from.integer("slot", 1);
  s.repetition = from.integer("repetition", 1);
  s.step = from.integer("step", 1);
  s.seed = from.count("seed");
  s.utc = from.utc("utc");
  s.environment = from.hex("environment");
  s.point = read_point(from.nested("point"));
  s.error.reset();
  if (from.has("error")) s.error = from.text("error");
  s.phases = read_or_null<phases>(from, "phases", read_phases);
  if (s.error && s.phases) from.reject("phases", "null in a row with \"error\"");
  if (!s.error && !s.phases) from.reject("phases", "an object in a row without \"error\"");
  s.threads_busy_s = from.seconds_list_or_null("threads_busy_s");
  s.barrier_wait_s = from.seconds_list_or_null("barrier_wait_s");
  s.work = read_or_null<work_row>(from, "work", read_work);
  s.peak_rss_bytes = from.count_or_null("peak_rss_bytes");
  s.verify = read_verify(from.nested("verify"));
  from.finish();
}

void from_json(const json& j, environment_row& e) {
  fields from(j);
  read_head(from, "environment");
  e.study = from.text("study");
  e.utc = from.utc("utc");
  e.environment = from.hex("environment");
  e.host = from.text("host");
  e.cpu = from.text("cpu");
  e.caches.clear();
  fields caches = from.nested("caches");
  for (const auto& item : from.at("caches").items()) e.caches[item.key()] = caches.count(item.key().c_str());
  e.cores = from.integer("cores", 1);
  e.governor = from.text_or_null("governor");
  e.os_kernel = from.text("os_kernel");
  e.compiler = from.text("compiler");
  e.flags = from.text("flags");
  e.libraries.clear();
  fields libraries = from.nested("libraries");
  for (const auto& item : from.at("libraries").items()) e.libraries[item.key()] = libraries.text(item.key().c_str());
  e.git = from.text("git");
  e.dirty = from.boolean("dirty");
  e.binding = from.text("binding");
  from.finish();
}

void from_json(const json& j, void_row& v) {
  fields from(j);
  read_head(from, "void");
  v.study = from.text("study");
  v.utc = from.utc("utc");
  v.round = from.integer("round", 1);
  v.reason = from.text("reason");
  from.finish();
}

std::string format_row(const row& value) {
  json j;
  std::visit([&j](const auto& v) { to_json(j, v); }, value);
  return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

row parse_row(const json& j) {
  fields from(j);
  from.literal("schema", row_schema);
  const std::string kind = from.text("kind");
  if (kind == "sample") return j.get<sample>();
  if (kind == "environment") return j.get<environment_row>();
  if (kind == "void") return j.get<void_row>();
  throw error("key \"kind\" should be \"sample\", \"environment\" or \"void\", is \"" + kind + "\"");
}

}  // namespace pairsum::harness
