#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// The rows of a results file as plain structs; keys and meaning are those of docs/design.md,
/// section 3.
namespace pairsum::harness {

inline constexpr const char* row_schema = "pairsum.row/3";
/// Rows of this schema are still read; values that they lack stay empty.
inline constexpr const char* former_row_schema = "pairsum.row/2";

/// What was measured. Two rows belong to the same point exactly if these fields are equal.
struct point {
  std::string case_name;  ///< key "case"
  std::string state;
  double dx = 0;  ///< particle spacing [m]
  double H = 0;   ///< support radius [m]
  std::uint64_t n_fluid = 0;
  std::uint64_t n_boundary = 0;
  std::string order;
  int dim = 3;
  std::string precision;
  std::string interaction;
  std::string smoothing;
  std::string integrator;
  double dt = 0;  ///< time step [s]
  std::string backend;
  std::string grid;
  int M = 0;                   ///< 0 (null in JSON) where the grid takes none
  int threads = 1;             ///< of each rank
  int ranks = 1;               ///< processes of an MPI job that share the particles; older rows have none
  std::string cut = "none";    ///< who sums pairs across ranks, "twice" or "once"; "none" (null in JSON) for one rank
  std::string granularity;     ///< how its loops are distributed, "dynamic:32"; "none" for serial backends
  std::string isa;             ///< of the vector units that it used, or "scalar"; older rows have for scalar
                               ///< backends what they were compiled for
  std::string block = "none";  ///< blocks of cells, "auto" or "slab:4"; "none" for backends without
  std::string particles;       ///< 16 hex digits of particles that no case makes: see particles_row; "" of a case
  bool operator==(const point&) const = default;
};

/// Seconds per phase of one step; empty where the phase was not timed.
struct phases {
  std::optional<double> index_s, prepare_s, zero_s, sum_s, reduce_s, integrate_s, total_s;
  bool operator==(const phases&) const = default;
};

struct phase_member {
  const char* name;
  std::optional<double> phases::*value;
};

/// The phases in the order in which a step runs them, with their keys.
inline constexpr std::array<phase_member, 7> phase_members{{{"index_s", &phases::index_s},
                                                            {"prepare_s", &phases::prepare_s},
                                                            {"zero_s", &phases::zero_s},
                                                            {"sum_s", &phases::sum_s},
                                                            {"reduce_s", &phases::reduce_s},
                                                            {"integrate_s", &phases::integrate_s},
                                                            {"total_s", &phases::total_s}}};

/// Of a sum on vector units or over blocks of cells: blocks as made, and vectors of pairs with the share of lanes in
/// use.
struct vector_use {
  std::string block;
  std::uint64_t lanes = 0, vectors = 0;
  double occupancy = 0;
  bool operator==(const vector_use&) const = default;
};

/// Counted work of the initial state; pairs count once each (i < j).
struct work_row {
  std::uint64_t cells = 0, cells_nonempty = 0, sumF1 = 0, sumF2 = 0, pairs_tested = 0, pairs_interacting = 0,
                pairs_fluid_fluid = 0, pairs_fluid_boundary = 0;
  std::optional<std::uint64_t> pairs_tested_unfolded;  ///< distance tests without folded cells
  std::optional<vector_use> vector_units{};            ///< of sums on vector units or over blocks
  std::optional<double> flops{}, bytes{};              ///< that one summation needs at least (docs/model.md)
  bool operator==(const work_row&) const = default;
};

/// Hardware counts of the summation phase, over all threads; each empty where the machine does not count it.
struct counters_row {
  std::optional<std::uint64_t> cycles, instructions, cache_misses;
  bool operator==(const counters_row&) const = default;
};

/// Seconds by [pass][thread].
using thread_times = std::vector<std::vector<double>>;

/// What was sent to other ranks.
struct traffic_row {
  std::uint64_t messages = 0, bytes = 0;
  bool operator==(const traffic_row&) const = default;
};

/// One rank's part of a step. Particles and pairs are those of the last evaluation, times and traffic of all of them.
struct rank_row {
  std::string host, cores;  ///< processing units of its threads, like "0,1"
  std::uint64_t own = 0, ghosts = 0, boundary = 0, pairs = 0, cut = 0;
  std::optional<double> busy_s, waiting_s;  ///< of the sum: its own work, and waiting for the last rank
  traffic_row halo, migrate, send_back, partition;
  bool operator==(const rank_row&) const = default;
};

/// Outcome of the verification. Without a fingerprint (16 hex digits) the row is unverified.
struct verify_row {
  std::optional<double> max_rel_err, bound;
  std::optional<std::string> fingerprint;
  bool operator==(const verify_row&) const = default;
};

/// One timed step of a repetition. `phases` is empty exactly if `error` or `untimed` is set.
struct sample {
  std::string study, part;
  int round = 1, slot = 1, repetition = 1, step = 1;  ///< each counts from 1
  std::uint64_t seed = 0;
  std::string utc;          ///< like 2026-11-22T15:30:00.123Z
  std::string environment;  ///< 16 hex digits, id of an environment row written before
  struct point point;
  std::optional<struct phases> phases;
  std::optional<thread_times> threads_busy_s;  ///< work in the passes of the summation, if the backend has passes
  std::optional<thread_times> barrier_wait_s;  ///< the rest of the pass: waiting for the others
  std::optional<counters_row> counters;
  std::optional<work_row> work;
  std::optional<std::uint64_t> peak_rss_bytes;
  std::optional<std::uint64_t> workspace_bytes{};  ///< that the backend holds after its first evaluation
  std::optional<std::uint64_t> lost{};             ///< particles found outside Omega in the step, no longer summed
  std::optional<std::uint64_t> threads_worked{};   ///< of the team, as threads_worked() counts them
  std::optional<std::vector<rank_row>> ranks{};    ///< by rank, of a point with several
  verify_row verify;
  std::optional<std::string> error;
  std::optional<std::string> untimed{};  ///< why a step that was verified has no times
  bool operator==(const sample&) const = default;
};

/// Where and how the samples that name it were measured.
struct environment_row {
  std::string study, utc, environment, host, cpu;
  std::map<std::string, std::uint64_t> caches;  ///< bytes per cache level
  int cores = 1;
  std::optional<std::string> governor;
  std::string os_kernel, compiler, flags;
  std::map<std::string, std::string> libraries;
  std::string git;
  bool dirty = false;
  std::string binding;   ///< which processing unit each thread is pinned to, or "none"
  std::string counters;  ///< what the hardware counts, or "none: why"
  std::string limits;    ///< of control groups, "2.5 processors, 4 GiB of memory" or "none"; "" in older rows
  bool operator==(const environment_row&) const = default;
};

/// A backend that tests the harness: a copy of another, with a known ratio of times.
struct self_test_row {
  std::string what, base_backend;
  std::optional<double> expected;  ///< none where verification must refuse it
  bool operator==(const self_test_row&) const = default;
};

/// The description of a backend, before the samples that name it; words and meaning are those of `pairsum list`.
struct backend_row {
  std::string study, utc, environment, name, description, aliases, runtime, conflicts;
  bool symmetric = false, deterministic = false, vector = false, blocks = false;
  std::optional<self_test_row> self_test;
  bool operator==(const backend_row&) const = default;
};

/// Particles that no case makes, read from files or evolved, before the samples that name them.
struct particles_row {
  std::string study, utc, particles;  ///< 16 hex digits of their bits and their domain
  std::vector<std::string> files;
  /// What was read, given, derived or assumed: what, value, how, from.
  std::vector<std::array<std::string, 4>> facts;
  bool operator==(const particles_row&) const = default;
};

/// The machine's best rates with so many threads, measured by the program: the model's bounds.
struct peak_row {
  std::string study, utc, environment;
  int threads = 1;
  std::string precision;
  double bandwidth_bytes_per_s = 0, flops_per_s = 0;
  bool operator==(const peak_row&) const = default;
};

/// The rate of multiply-adds during a round, the baseline for speedups of that round.
struct pace_row {
  std::string study, utc, environment;
  int round = 1;
  int threads = 1;
  std::string precision;
  double flops_per_s = 0;
  bool operator==(const pace_row&) const = default;
};

/// Closes a round: all its rows are in the file. A round without this row is unfinished.
struct round_row {
  std::string study, utc, environment;
  int round = 1;
  std::string part;
  int replicate = 1;  ///< the part's own count of rounds
  std::string plan;   ///< 16 hex digits: the plan's hash
  std::uint64_t seed = 0;
  std::uint64_t rows = 0;  ///< samples of the round
  double elapsed_s = 0;
  std::optional<double> others_share;  ///< of the machine's CPU time, used by other processes meanwhile
  bool operator==(const round_row&) const = default;
};

/// Says that a plan was carried out to its end.
struct end_row {
  std::string study, utc, plan, reason;
  bool operator==(const end_row&) const = default;
};

/// Says that the rows of a round of a study do not count.
struct void_row {
  std::string study, utc;
  int round = 1;
  std::string reason;
  bool operator==(const void_row&) const = default;
};

using row =
    std::variant<sample, environment_row, backend_row, void_row, peak_row, pace_row, round_row, end_row, particles_row>;

/// To JSON with exactly the keys of the schema; numbers that are not finite become null.
void to_json(nlohmann::json& json, const point& value);
void to_json(nlohmann::json& json, const phases& value);
void to_json(nlohmann::json& json, const vector_use& value);
void to_json(nlohmann::json& json, const work_row& value);
void to_json(nlohmann::json& json, const rank_row& value);
void to_json(nlohmann::json& json, const verify_row& value);
void to_json(nlohmann::json& json, const sample& value);
void to_json(nlohmann::json& json, const environment_row& value);
void to_json(nlohmann::json& json, const backend_row& value);
void to_json(nlohmann::json& json, const void_row& value);
void to_json(nlohmann::json& json, const peak_row& value);
void to_json(nlohmann::json& json, const pace_row& value);
void to_json(nlohmann::json& json, const round_row& value);
void to_json(nlohmann::json& json, const end_row& value);
void to_json(nlohmann::json& json, const particles_row& value);
void to_json(nlohmann::json& json, const counters_row& value);

/// From JSON, strictly: a missing, unknown or ill-typed key throws pairsum::error naming it.
void from_json(const nlohmann::json& json, point& value);
void from_json(const nlohmann::json& json, phases& value);
void from_json(const nlohmann::json& json, work_row& value);
void from_json(const nlohmann::json& json, verify_row& value);
void from_json(const nlohmann::json& json, sample& value);
void from_json(const nlohmann::json& json, environment_row& value);
void from_json(const nlohmann::json& json, backend_row& value);
void from_json(const nlohmann::json& json, void_row& value);
void from_json(const nlohmann::json& json, peak_row& value);
void from_json(const nlohmann::json& json, pace_row& value);
void from_json(const nlohmann::json& json, round_row& value);
void from_json(const nlohmann::json& json, end_row& value);
void from_json(const nlohmann::json& json, particles_row& value);

/// The row as one line of JSON, without the newline.
std::string format_row(const row& value);

/// The row of one parsed line; throws pairsum::error naming the key that is wrong.
row parse_row(const nlohmann::json& json);

}  // namespace pairsum::harness
