// The rows of a study that are no samples: environment, peak, pace, round, end, void.
#include "harness/rows/json_parts.hpp"

namespace pairsum::harness {

using nlohmann::json;

void to_json(json& j, const environment_row& e) {
  j = head("environment", e);
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
  j["counters"] = e.counters;
}

void from_json(const json& j, environment_row& e) {
  fields from(j);
  read_head(from, "environment", e);
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
  e.counters = from.text("counters");
  from.finish();
}

void to_json(json& j, const void_row& v) {
  j = head("void", v);
  j["round"] = v.round;
  j["reason"] = v.reason;
}

void from_json(const json& j, void_row& v) {
  fields from(j);
  read_head(from, "void", v);
  v.round = from.integer("round", 1);
  v.reason = from.text("reason");
  from.finish();
}

void to_json(json& j, const peak_row& p) {
  j = head("peak", p);
  j["threads"] = p.threads;
  j["precision"] = p.precision;
  j["bandwidth_bytes_per_s"] = finite(p.bandwidth_bytes_per_s);
  j["flops_per_s"] = finite(p.flops_per_s);
}

void from_json(const json& j, peak_row& p) {
  fields from(j);
  read_head(from, "peak", p);
  p.threads = from.integer("threads", 1);
  p.precision = from.text("precision");
  p.bandwidth_bytes_per_s = from.positive("bandwidth_bytes_per_s");
  p.flops_per_s = from.positive("flops_per_s");
  from.finish();
}

void to_json(json& j, const pace_row& p) {
  j = head("pace", p);
  j["round"] = p.round;
  j["threads"] = p.threads;
  j["precision"] = p.precision;
  j["flops_per_s"] = finite(p.flops_per_s);
}

void from_json(const json& j, pace_row& p) {
  fields from(j);
  read_head(from, "pace", p);
  p.round = from.integer("round", 1);
  p.threads = from.integer("threads", 1);
  p.precision = from.text("precision");
  p.flops_per_s = from.positive("flops_per_s");
  from.finish();
}

void to_json(json& j, const round_row& r) {
  j = head("round", r);
  j["round"] = r.round;
  j["part"] = r.part;
  j["replicate"] = r.replicate;
  j["plan"] = r.plan;
  j["seed"] = r.seed;
  j["rows"] = r.rows;
  j["elapsed_s"] = finite(r.elapsed_s);
  j["others_share"] = finite(r.others_share);
}

void from_json(const json& j, round_row& r) {
  fields from(j);
  read_head(from, "round", r);
  r.round = from.integer("round", 1);
  r.part = from.text("part");
  r.replicate = from.integer("replicate", 1);
  r.plan = from.hex("plan");
  r.seed = from.count("seed");
  r.rows = from.count("rows");
  r.elapsed_s = from.positive("elapsed_s");
  r.others_share = from.seconds_or_null("others_share");
  from.finish();
}

void to_json(json& j, const end_row& e) {
  j = head("end", e);
  j["plan"] = e.plan;
  j["reason"] = e.reason;
}

void from_json(const json& j, end_row& e) {
  fields from(j);
  read_head(from, "end", e);
  e.plan = from.hex("plan");
  e.reason = from.text("reason");
  from.finish();
}

}  // namespace pairsum::harness
