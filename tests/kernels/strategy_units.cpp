// What each strategy's units of work write to, found by running the backends: the data that docs/strategies.md is
// illustrated from. Prints JSON; plots/strategy_pictures.py draws it. Two dimensions, every cell full, all candidates
// taken to interact.
//
//   strategy_units > docs/strategies/units.json
#include <omp.h>

#include <cmath>
#include <iostream>
#include <optional>
#include <set>
#include <string>

#include <pairsum/cases/case.hpp>
#include <pairsum/grid/indexer.hpp>
#include <pairsum/schedule/block_conflicts.hpp>
#include <pairsum/schedule/coloured_cells.hpp>
#include <pairsum/schedule/coloured_packs.hpp>
#include <pairsum/schedule/half_blocks.hpp>
#include <pairsum/schedule/locked_slabs.hpp>
#include <pairsum/schedule/slab_colours.hpp>
#include <pairsum/schedule/touched_pieces.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/registry.hpp>
#include <pairsum/sum/setup_of.hpp>
#include "unit_trace.hpp"

namespace pairsum {
namespace {

using test_kit::counted_problem;
using test_kit::schedule_of;
using test_kit::unit_observer;
using problem_2d = problem<2, double>;
using schedule_2d = schedule<2, double>;
using place = std::array<int, 2>;
using places = std::set<place>;

/// A square of cells, `cells` along an edge, with `per_edge` x `per_edge` particles each.
struct square {
  int cells = 12, per_edge = 2;
  std::string grid = "dense_grid";
  int M = 0;
  std::string block = "auto";
  double skin = 0;  ///< of lists of pairs, in units of H
};

/// It, sorted and ready to be summed.
class scene_in_2d {
 public:
  explicit scene_in_2d(const square& w)
      : start_(start_of(w)), world(setup_of(start_)), index_(make_box<2, double>(world), grid_of(w)) {
    world.grid = w.grid;
    world.block = w.block;
    world.cores = 1;
    fill(particles_, start_.particles);
    index_.build(particles_, team());
    counted.emplace(particles_, index_, world);
  }
  const cells<2>& all_cells() const { return index_.view(); }

  /// Where particles lie, in cells cut in `parts` along each edge.
  template <class Particles>
  places of(const Particles& particles, int parts = 1) const {
    places found;
    const cells<2>& c = all_cells();
    for (const std::uint32_t i : particles) {
      place at{};
      for (int d = 0; d < 2; ++d) {
        at[d] = static_cast<int>(std::floor((particles_.x[d][i] - c.low[d]) * c.per_metre[d] * parts));
        if (c.period[d] > 0) at[d] %= static_cast<int>(c.period[d]) * parts;
      }
      found.insert(at);
    }
    return found;
  }
  place of_cell(std::size_t cell) const { return as_place(all_cells().place[cell]); }
  places of_cells(std::span<const std::uint32_t> cells) const {
    places found;
    for (const std::uint32_t cell : cells) found.insert(of_cell(cell));
    return found;
  }
  places of_cells(std::size_t begin, std::size_t end) const {
    places found;
    for (std::size_t cell = begin; cell < end; ++cell) found.insert(of_cell(cell));
    return found;
  }
  /// The base cell, -1 at the least if that is beside the grid.
  place base(const block<2>& members) const {
    ivec<2> at = base_of<2>(members, all_cells());
    for (int d = 0; d < 2; ++d)
      if (all_cells().period[d] > 0) at[d] = (at[d] + all_cells().period[d]) % all_cells().period[d];
    return as_place(at);
  }
  /// The cells that a gather of this cell reads.
  places around(const places& own) const {
    places found;
    for (std::size_t cell = 1; cell <= all_cells().fluid_cells; ++cell)
      if (own.count(of_cell(cell)) > 0)
        for (unsigned n = 0; n < cells<2>::stencil; ++n)
          if (const std::uint32_t other = all_cells().neighbour(cell, n); other != 0) found.insert(of_cell(other));
    return found;
  }

 private:
  static place as_place(const ivec<2>& at) { return {static_cast<int>(at[0]), static_cast<int>(at[1])}; }
  static initial_condition start_of(const square& w) {
    initial_condition made = make_case("lattice", {.dim = 2, .dx = 1.0 / (w.cells * w.per_edge)});
    made.H = 1.0 / w.cells;
    return made;
  }
  std::unique_ptr<grid<2, double>> grid_of(const square& w) const {
    setup s = setup_of(start_);
    s.grid = w.grid;
    s.M = w.M;
    s.constants.H *= 1 + w.skin;
    return make_grid<2, double>(s);
  }

  initial_condition start_;

 public:
  setup world;

 private:
  particle_set<2, double> particles_;
  indexer<2, double> index_;

 public:
  std::optional<counted_problem<2>> counted;
};

/// What a unit wrote while it held the same locks: to rates or copies of them, by their memory, and to buffers.
struct stretch_of_unit {
  std::int32_t low = -1, high = -1;
  std::map<const void*, std::set<std::uint32_t>> written;
  std::set<std::uint32_t> buffered;
};
struct unit_record {
  unsigned pass;
  std::size_t number;
  std::vector<stretch_of_unit> stretches;
};

/// The formula's functions, between which the rates are looked at: whatever schedules say of themselves.
class units_trace : public unit_observer, public pair_sum<2, double> {
 public:
  units_trace(const problem_2d& p, int threads)
      : pair_sum<2, double>(*p.pairs), by_thread(static_cast<std::size_t>(threads)), right_(*p.pairs) {
    each_update<update::plain>();
    each_update<update::atomic>();
    each_update<update::split>();
    own = [](const void* call, const row* rows, std::size_t n) { look_at(call, rows, n, of(call).right_.own); };
  }

  void unit_begins(unsigned pass, std::size_t k) override {
    by_thread[static_cast<std::size_t>(omp_get_thread_num())].push_back({pass, k, {stretch_of_unit()}});
  }
  void locks(std::int32_t low, std::int32_t high) { by_thread[0].back().stretches.push_back({low, high, {}, {}}); }

  std::vector<std::vector<unit_record>> by_thread;

 private:
  static const sum_call<2, double>& as_call(const void* call) { return *static_cast<const sum_call<2, double>*>(call); }
  static units_trace& of(const void* call) {
    return const_cast<units_trace&>(static_cast<const units_trace&>(*as_call(call).p.pairs));
  }
  template <update How>
  void each_update() {
    both[static_cast<unsigned>(How)] = [](const void* call, const row* rows, std::size_t n) {
      look_at(call, rows, n, of(call).right_.both[static_cast<unsigned>(How)]);
    };
  }
  static void look_at(const void* call, const row* rows, std::size_t n, rows_function right) {
    const auto& c = as_call(call);
    const auto* const u = static_cast<const std::uint64_t*>(c.to.u.begin[0]);
    const std::vector<std::uint64_t> before(u, u + c.p.fluid_count);
    const auto in_buffer = [&](std::uint32_t i) -> const std::uint64_t* {
      if (c.to.slot == nullptr || c.to.slot[i / split_block] == unsplit) return nullptr;
      return static_cast<const std::uint64_t*>(c.to.buffer.begin[0]) + c.to.slot[i / split_block] * split_block +
             i % split_block;
    };
    std::map<std::uint32_t, std::uint64_t> buffers;
    const auto name = [&](std::uint32_t i) {
      if (const std::uint64_t* const at = in_buffer(i)) buffers[i] = *at;
    };
    for (const row* r = rows; r != rows + n; ++r) {
      name(r->i);
      for (std::uint32_t k = 0; k < r->fluid_count; ++k) name(r->fluid[k]);
    }
    right(call, rows, n);
    stretch_of_unit& now = of(call).by_thread[static_cast<std::size_t>(c.to.thread)].back().stretches.back();
    for (std::uint32_t i = 0; i < before.size(); ++i)
      if (u[i] != before[i]) now.written[u].insert(i);
    for (const auto& [i, was] : buffers)
      if (*in_buffer(i) != was) now.buffered.insert(i);
  }

  const pair_sum<2, double>& right_;
};

/// In place of locks: tells the trace which would be held.
struct traced_locks {
  static inline units_trace* trace = nullptr;
  void resize(std::size_t) {}
  struct guard {
    template <class Wait>
    guard(traced_locks&, std::int32_t low, std::int32_t high, Wait&&) {
      trace->locks(low, high);
    }
    ~guard() { trace->locks(-1, -1); }
  };
};

/// What the units of a schedule did, on threads of the team that sums, by thread.
std::vector<std::vector<unit_record>> traced(scene_in_2d& s, schedule_2d& tried, const backend_traits& t,
                                             const team& prepares, const team& sums) {
  problem_2d p = s.counted->p;
  units_trace trace(p, sums.threads());
  traced_locks::trace = &trace;
  p.pairs = &trace;
  p.threads = prepares.threads();
  tried.prepare(p, prepares);
  tried.zero(p, prepares);
  tried.sum(p, sums, t, pass_marks(&trace));
  return std::move(trace.by_thread);
}
const backend_entry& backend(std::string_view name) { return registry::instance().find_backend(std::string(name)); }
/// On one thread.
std::vector<unit_record> traced(scene_in_2d& s, schedule_2d& tried, const backend_traits& t) {
  const workers one(t.threads, 1);
  return traced(s, tried, t, one.get(), one.get()).front();
}

// ---- JSON

std::string text(const places& s) {
  std::string out = "[";
  for (const place& at : s)
    out += (out.size() > 1 ? ",[" : "[") + std::to_string(at[0]) + "," + std::to_string(at[1]) + "]";
  return out + "]";
}

/// One unit: sets of cells by what they are.
struct drawn_unit {
  std::map<std::string, places> sets;
  std::map<int, places> locks;
};

class drawing {
 public:
  drawing(std::string name, const square& w, const scene_in_2d& s, std::string block = "none", int parts = 1)
      : head_("\"" + name + "\": {\"cells\": " + std::to_string(extent(s)) + ", \"parts\": " + std::to_string(parts) +
              ", \"particles\": " + std::to_string(w.per_edge * w.per_edge) + ", \"grid\": \"" + w.grid +
              "\", \"M\": " + std::to_string(w.M) + ", \"block\": \"" + block + "\"") {}

  void add(unsigned pass, drawn_unit u) { passes_[pass].push_back(std::move(u)); }
  void edges(const std::vector<block_pair>& pairs) {
    head_ += ", \"edges\": [";
    for (const auto& [a, b] : pairs)
      head_ += (head_.back() == '[' ? "[" : ", [") + std::to_string(a) + "," + std::to_string(b) + "]";
    head_ += "]";
  }
  std::string json() const {
    std::string out = head_ + ", \"passes\": [";
    for (const auto& [pass, units] : passes_) {
      out += out.back() == '[' ? "\n  [" : ",\n  [";
      for (const drawn_unit& u : units) {
        out += out.back() == '[' ? "{" : ",\n   {";
        for (const auto& [name, cells] : u.sets)
          out += (out.back() == '{' ? "\"" : ", \"") + name + "\": " + text(cells);
        if (!u.locks.empty()) out += ", \"locks\": {";
        for (const auto& [lock, cells] : u.locks)
          out += (out.back() == '{' ? "\"" : ", \"") + std::to_string(lock) + "\": " + text(cells);
        out += u.locks.empty() ? "}" : "}}";
      }
      out += "]";
    }
    return out + "]}";
  }

 private:
  static int extent(const scene_in_2d& s) {
    int most = 0;
    for (std::size_t cell = 1; cell <= s.all_cells().fluid_cells; ++cell)
      for (const int x : s.of_cell(cell)) most = std::max(most, x + 1);
    return most;
  }

  std::string head_;
  std::map<unsigned, std::vector<drawn_unit>> passes_;
};

/// Units of a backend that writes to the rates alone; own(scene, block, pass, k): the cells that a unit goes over, of
/// those it writes to.
template <class Own>
std::string units(std::string_view name, const square& w, Own&& own, std::string_view title = {}, int parts = 1) {
  const backend_entry& b = backend(name);
  scene_in_2d s(w);
  const auto tried = schedule_of<2>(b, s.world);
  const auto records = traced(s, *tried, b.traits);
  drawing d(std::string(title.empty() ? name : title), w, s, tried->block(), parts);
  for (const unit_record& u : records) {
    drawn_unit drawn;
    drawn.sets["own"] = own(s, tried->block(), u.pass, u.number);
    places& rates = drawn.sets["rates"];
    for (const auto& [memory, written] : u.stretches[0].written) rates.merge(s.of(written, parts));
    if (!b.traits.symmetric) drawn.sets["reads"] = s.around(drawn.sets["own"]);
    d.add(u.pass, std::move(drawn));
  }
  return d.json();
}

template <bool one_pass>
constexpr auto own_of_blocks = [](const scene_in_2d& s, const std::string& word, unsigned pass, std::size_t k) {
  cell_blocks<2> blocks;
  blocks.shape(block_shape::parse(word), one_pass);
  blocks.build(s.all_cells());
  return s.of_cells(blocks(pass, k));
};
constexpr auto own_cell = [](const scene_in_2d& s, const std::string&, unsigned, std::size_t k) {
  return places{s.of_cell(k + 1)};
};
coloured_blocks<2> base_blocks_of(const scene_in_2d& s) {
  coloured_blocks<2> blocks;
  blocks.build(s.all_cells(), team());
  return blocks;
}

/// Three threads with fixed pieces of 32 cells: the copy each of them has, what it wrote there, and the cells it swept.
std::string private_copies() {
  const square w;
  scene_in_2d s(w);
  const backend_entry& b = backend("thread_private");
  const team three = team::omp(3).with({loop_schedule::fixed, 32});
  drawing d("thread_private", w, s);
  for (const auto& records : traced(s, *schedule_of<2>(b, s.world), b.traits, three, three)) {
    drawn_unit drawn;
    for (const unit_record& u : records) {
      drawn.sets["own"].insert(s.of_cell(u.number + 1));
      for (const auto& [memory, written] : u.stretches[0].written) drawn.sets["copy"].merge(s.of(written));
    }
    d.add(0, std::move(drawn));
  }
  return d.json();
}

/// A pass here is a copy; blocks of all run at the same time.
std::string pass_copies() {
  const square w;
  scene_in_2d s(w);
  const backend_entry& b = backend("per_pass_buffers");
  const coloured_blocks<2> blocks = base_blocks_of(s);
  drawing d("per_pass_buffers", w, s);
  unsigned pass = 0;
  std::size_t before = 0;  // blocks of the passes before
  for (const unit_record& u : traced(s, *schedule_of<2>(b, s.world), b.traits)) {
    for (; u.number - before >= blocks[pass].size(); ++pass) before += blocks[pass].size();
    for (const auto& [memory, written] : u.stretches[0].written)
      d.add(pass, {{{"own", {s.base(blocks[pass][u.number - before])}}, {"copy", s.of(written)}}, {}});
  }
  return d.json();
}

/// With so many particles that there are several pieces.
std::string buffered_blocks() {
  const square w{.cells = 12, .per_edge = 11};
  scene_in_2d s(w);
  const backend_entry& b = backend("touched_blocks");
  touched_pieces<2> pieces;
  pieces.build(s.all_cells(), s.counted->p.fluid_count, team());
  drawing d("touched_blocks", w, s);
  for (const unit_record& u : traced(s, *schedule_of<2>(b, s.world), b.traits)) {
    const auto& piece = pieces[u.number];
    drawn_unit drawn;
    drawn.sets["own"] = s.of_cells(piece.cell_begin, piece.cell_end);
    places& rates = drawn.sets["rates"];
    for (const auto& [memory, written] : u.stretches[0].written) rates.merge(s.of(written));
    drawn.sets["copy"] = s.of(u.stretches[0].buffered);
    d.add(0, std::move(drawn));
  }
  return d.json();
}

std::vector<cell_layer> layers_of(const scene_in_2d& s) {
  std::vector<cell_layer> layers;
  find_layers(s.all_cells(), layers);
  return layers;
}

/// Slabs for three threads, one after the other.
std::string slabs_with_locks() {
  const square w;
  scene_in_2d s(w);
  const cells<2>& c = s.all_cells();
  const std::vector<cell_layer> layers = layers_of(s);
  std::vector<std::uint64_t> work;
  for (const cell_layer& layer : layers) work.push_back(candidates_in(c, layer));
  const std::vector<slab> slabs = cut_slabs(layers, work, layers_around(c), 3);
  slabs_with<2, double, traced_locks> tried;
  drawing d("sliced_locks", w, s);
  const auto records = traced(s, tried, tried.traits, team::omp(3), team::omp(1));
  for (const unit_record& u : records.front()) {
    drawn_unit drawn;
    for (const stretch& part : slabs[u.number]) drawn.sets["own"].merge(s.of_cells(part.begin, part.end));
    for (const stretch_of_unit& part : u.stretches)
      for (const auto& [memory, particles] : part.written) {
        const places written = s.of(particles);
        drawn.sets["rates"].insert(written.begin(), written.end());
        for (const std::int32_t lock : {part.low, part.high})
          if (lock >= 0) drawn.locks[lock].insert(written.begin(), written.end());
      }
    d.add(0, std::move(drawn));
  }
  return d.json();
}

/// Passes are the colours that orient the edges; units are numbered as blocks are.
std::string tasks() {
  const square w{.block = "brick:3"};
  scene_in_2d s(w);
  const backend_entry& b = backend("task_conflicts");
  const auto tried = schedule_of<2>(b, s.world);
  auto records = traced(s, *tried, b.traits);
  cell_blocks<2> blocks;
  blocks.shape(block_shape::parse(tried->block()), true);
  blocks.build(s.all_cells());
  const std::vector<block_pair> conflicts = conflicts_of(s.all_cells(), blocks);
  const std::vector<unsigned> colour = colours_for(blocks.size(0), conflicts);
  std::ranges::sort(records, {}, &unit_record::number);
  std::vector<std::pair<unsigned, std::uint32_t>> by_colour;
  for (std::uint32_t k = 0; k < records.size(); ++k) by_colour.emplace_back(colour[k], k);
  std::ranges::sort(by_colour);
  std::vector<std::uint32_t> at(by_colour.size());  // where a task is drawn
  for (std::uint32_t k = 0; k < by_colour.size(); ++k) at[by_colour[k].second] = k;
  drawing d("task_conflicts", w, s, tried->block());
  for (const auto& [own_colour, k] : by_colour) {
    drawn_unit drawn;
    drawn.sets["own"] = s.of_cells(blocks(0, k));
    for (const auto& [memory, written] : records[k].stretches[0].written) drawn.sets["rates"].merge(s.of(written));
    d.add(own_colour, std::move(drawn));
  }
  std::vector<block_pair> edges;
  for (const auto& [a, b] : conflicts) edges.emplace_back(std::min(at[a], at[b]), std::max(at[a], at[b]));
  d.edges(edges);
  return d.json();
}

std::vector<std::string> all() {
  const square plain, seam{.cells = 8, .grid = "hashed_grid", .M = 3};
  const auto coloured_cell = [](const scene_in_2d& s, const std::string&, unsigned pass, std::size_t k) {
    coloured_cells<2> by_colour;
    by_colour.build(s.all_cells());
    return places{s.of_cell(by_colour[pass][k])};
  };
  const auto half_base = [](const scene_in_2d& s, const std::string&, unsigned pass, std::size_t k) {
    half_blocks<2> blocks;
    blocks.build(s.all_cells(), team());
    const auto unit = blocks(pass, k);
    place at = s.base(*unit.cells);
    for (int d = 0; d < 2; ++d) at[d] = 2 * at[d] + static_cast<int>(unit.part >> d & 1);
    return places{at};
  };
  const auto packed_bases = [](const scene_in_2d& s, const std::string&, unsigned pass, std::size_t k) {
    coloured_packs<2> packs;
    packs.build(s.all_cells());
    places found;
    for (std::size_t b = packs(pass, k).begin; b < packs(pass, k).end; ++b) found.insert(s.base(packs.blocks()[b]));
    return found;
  };
  const auto every_base = [](const scene_in_2d& s, const std::string&, unsigned, std::size_t k) {
    std::vector<block<2>> blocks;
    each_block(s.all_cells(), 1, s.all_cells().fluid_cells + 1,
               [&](unsigned, const block<2>& b) { blocks.push_back(b); });
    return places{s.base(blocks[k])};
  };
  const auto base = [](const scene_in_2d& s, const std::string&, unsigned pass, std::size_t k) {
    return places{s.base(base_blocks_of(s)[pass][k])};
  };
  const auto slab_of = [](const scene_in_2d& s, const std::string&, unsigned pass, std::size_t k) {
    const auto layers = layers_of(s);
    const slab_colours cut(slab_thickness(s.counted->p.fluid_count, layers.size()), layers_around(s.all_cells()));
    const slab_cells slab = coloured_slabs(layers, cut)[pass][k];
    return s.of_cells(slab.begin, slab.end);
  };
  return {units("naive_omp", plain, own_cell),
          units("naive_tiles_omp", {.block = "brick:4"}, own_of_blocks<true>),
          units("sphysics_sweep", plain, own_cell),
          units("ppm_stencil", plain, every_base),
          units("symmetric_omp", plain, base),
          units("tiles_omp", {.block = "brick:2"}, own_of_blocks<false>),
          units("colour18", plain, coloured_cell),
          units("colour18", seam, coloured_cell, "colour18_seam"),
          units("colour4", {.cells = 16}, packed_bases),
          units("half_cells", plain, half_base, "half_cells", 2),
          units("half_cells", seam, half_base, "half_cells_seam", 2),
          units("pair_list_omp", {.block = "slab:2"}, own_of_blocks<false>),
          units("verlet_list", {.block = "slab:2", .skin = backend("verlet_list").traits.skin}, own_of_blocks<false>),
          units("sliced_2colour", plain, slab_of),
          slabs_with_locks(),
          tasks(),
          units("atomic_add", plain, own_cell),
          private_copies(),
          pass_copies(),
          buffered_blocks()};
}

}  // namespace
}  // namespace pairsum

int main() {
  std::cout << "{\n";
  bool first = true;
  for (const std::string& one : pairsum::all()) {
    std::cout << (first ? "" : ",\n") << one;
    first = false;
  }
  std::cout << "\n}\n";
}
