// The rows of a study that are no samples: environment, backend, peak, pace, round, end, void.
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
  if (!e.limits.empty()) j["limits"] = e.limits;
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
  e.limits = from.has("limits") ? from.text("limits") : "";
  from.finish();
}

void to_json(json& j, const backend_row& b) {
  j = head("backend", b);
  j["name"] = b.name;
  j["description"] = b.description;
  j["aliases"] = b.aliases;
  j["runtime"] = b.runtime;
  j["conflicts"] = b.conflicts;
  j["symmetric"] = b.symmetric;
  j["deterministic"] = b.deterministic;
  j["vector"] = b.vector;
  j["blocks"] = b.blocks;
  j["self_test"] = nullptr;
  if (b.self_test)
    j["self_test"] = {{"what", b.self_test->what},
                      {"base_backend", b.self_test->base_backend},
                      {"expected", finite(b.self_test->expected)}};
}

void from_json(const json& j, backend_row& b) {
  fields from(j);
  from.literal("schema", row_schema);  // the former one had no such rows
  read_head(from, "backend", b);
  b.name = from.text("name");
  b.description = from.text("description");
  b.aliases = from.text("aliases");
  b.runtime = from.text("runtime");
  b.conflicts = from.text("conflicts");
  b.symmetric = from.boolean("symmetric");
  b.deterministic = from.boolean("deterministic");
  b.vector = from.boolean("vector");
  b.blocks = from.boolean("blocks");
  b.self_test.reset();
  if (!from.is_null("self_test")) {
    fields test = from.nested("self_test");
    b.self_test = {test.text("what"), test.text("base_backend"), test.amount_or_null("expected")};
    test.finish();
  }
  from.finish();
}

void to_json(json& j, const particles_row& p) {
  j = head("particles", p);
  j["particles"] = p.particles;
  j["files"] = p.files;
  j["facts"] = p.facts;
}

void from_json(const json& j, particles_row& p) {
  fields from(j);
  from.literal("schema", row_schema);  // the former one had no such rows
  read_head(from, "particles", p);
  p.particles = from.hex("particles");
  p.files = from.texts("files");
  p.facts.clear();
  for (const std::vector<std::string>& fact : from.text_table("facts", 4))
    p.facts.push_back({fact[0], fact[1], fact[2], fact[3]});
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
  r.others_share = from.amount_or_null("others_share");
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
