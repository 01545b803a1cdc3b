// What each strategy's units of work write to, found by running the backends: the data that docs/strategies.md is
// illustrated from. Prints JSON; plots/strategy_pictures.py draws it. Two dimensions, every cell full, all candidates
// taken to interact.
//
//   strategy_units > docs/strategies/units.json
#include <omp.h>

#include <cmath>
#include <iostream>
#include <set>
#include <string>

#include "backends/atomic_add.hpp"
#include "backends/colour18.hpp"
#include "backends/colour4.hpp"
#include "backends/half_cells.hpp"
#include "backends/naive_omp.hpp"
#include "backends/naive_tiles_omp.hpp"
#include "backends/pair_list_omp.hpp"
#include "backends/per_pass_buffers.hpp"
#include "backends/ppm_stencil.hpp"
#include "backends/sliced_2colour.hpp"
#include "backends/sliced_locks.hpp"
#include "backends/sphysics_sweep.hpp"
#include "backends/symmetric_omp.hpp"
#include "backends/task_conflicts.hpp"
#include "backends/thread_private.hpp"
#include "backends/tiles_omp.hpp"
#include "backends/touched_blocks.hpp"
#include "backends/verlet_list.hpp"
#include "cases/lattice.hpp"
#include "grid/indexer.hpp"
#include "sum/setup_of.hpp"
#include "unit_trace.hpp"

namespace pairsum {
namespace {

using test_kit::watched_rates;
using I = count<2, double>;
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
      : start_(start_of(w)),
        world(setup_of(start_)),
        index_(make_box<2, double>(world), grid_of(w)),
        columns_(world.constants, make_torus<2, double>(world)) {
    world.grid = w.grid;
    world.block = w.block;
    world.cores = 1;
    fill(particles_, start_.particles);
    index_.build(particles_, team());
    columns_.derive(particles_, index_.fluid(), index_.boundary(), team());
    columns_.zero_rates(team());
    p = columns_.view(particles_, index_.view());
    p.reach2 = p.boundary_reach2 = std::numeric_limits<double>::max();
  }

  /// Where particles lie, in cells cut in `parts` along each edge.
  places of(const std::vector<std::uint32_t>& particles, int parts = 1) const {
    places found;
    const cells<2>& c = p.cells();
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
  place of_cell(std::size_t cell) const { return as_place(p.cells().place[cell]); }
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
    ivec<2> at = base_of<2>(members, p.cells());
    for (int d = 0; d < 2; ++d)
      if (p.cells().period[d] > 0) at[d] = (at[d] + p.cells().period[d]) % p.cells().period[d];
    return as_place(at);
  }
  /// The cells that a gather of this cell reads.
  places around(const places& own) const {
    places found;
    for (std::size_t cell = 1; cell <= p.cells().fluid_cells; ++cell)
      if (own.count(of_cell(cell)) > 0)
        for (unsigned n = 0; n < cells<2>::stencil; ++n)
          if (const std::uint32_t other = p.cells().neighbour(cell, n); other != 0) found.insert(of_cell(other));
    return found;
  }

 private:
  static place as_place(const ivec<2>& at) { return {static_cast<int>(at[0]), static_cast<int>(at[1])}; }
  static initial_condition start_of(const square& w) {
    initial_condition made = lattice::make({.dim = 2, .dx = 1.0 / (w.cells * w.per_edge)});
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
  problem<I> p;

 private:
  particle_set<2, double> particles_;
  indexer<2, double> index_;
  interaction_columns<I> columns_;
};

/// What a unit wrote, by column watched, while it held the same locks.
struct stretch_of_unit {
  std::int32_t low = -1, high = -1;
  std::vector<std::vector<std::uint32_t>> written;
};
struct unit_record {
  unsigned pass;
  std::size_t number;
  std::vector<stretch_of_unit> stretches;
};

/// As test_kit::unit_trace, for several columns: the rates and copies of them.
class columns_trace : public no_probe {
 public:
  void watch(const field_pointers<rates_of<I>>& u, std::size_t n) { columns_.emplace_back(u, n); }
  void unit_begins(unsigned pass, std::size_t k) {
    close();
    units.push_back({pass, k, {stretch_of_unit()}});
    open_ = true;
  }
  void locks(std::int32_t low, std::int32_t high) {
    close();
    units.back().stretches.push_back({low, high, {}});
    open_ = true;
  }
  /// To be called after the sum, too.
  void close() {
    std::vector<std::vector<std::uint32_t>> written;
    for (auto& column : columns_) written.push_back(column.changed());
    if (open_) units.back().stretches.back().written = std::move(written);
    open_ = false;
  }

  std::vector<unit_record> units;

 private:
  std::vector<watched_rates<I>> columns_;
  bool open_ = false;
};

/// In place of locks: tells the trace which would be held.
struct traced_locks {
  columns_trace* trace = nullptr;
  void resize(std::size_t) {}
  struct guard {
    columns_trace* trace;
    template <class Wait>
    guard(traced_locks& locks, std::int32_t low, std::int32_t high, Wait&&) : trace(locks.trace) {
      trace->locks(low, high);
    }
    ~guard() { trace->locks(-1, -1); }
  };
};

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
    for (std::size_t cell = 1; cell <= s.p.cells().fluid_cells; ++cell)
      for (const int x : s.of_cell(cell)) most = std::max(most, x + 1);
    return most;
  }

  std::string head_;
  std::map<unsigned, std::vector<drawn_unit>> passes_;
};

template <class W>
std::string block_of(const W& workspace) {
  if constexpr (requires { workspace.block(); })
    return workspace.block();
  else
    return "none";
}

/// Units of a backend that writes to the rates alone; own(scene, workspace, pass, k): the cells that a unit goes over,
/// of those it writes to.
template <class B, class Own>
std::string units(const square& w, Own&& own, std::string_view name = B::traits.name, int parts = 1) {
  scene_in_2d s(w);
  typename B::template workspace<I> workspace;
  configure(workspace, s.world);
  columns_trace trace;
  with_one_thread(B::traits.threads, [&](const team& one) {
    workspace.prepare(s.p, one, trace);
    trace.watch(s.p.u, s.p.fluid_count);
    workspace.sum(s.p, one, trace);
  });
  trace.close();
  drawing d(std::string(name), w, s, block_of(workspace), parts);
  for (const unit_record& u : trace.units) {
    drawn_unit drawn;
    drawn.sets["own"] = own(s, workspace, u.pass, u.number);
    drawn.sets["rates"] = s.of(u.stretches[0].written[0], parts);
    if (!B::traits.symmetric) drawn.sets["reads"] = s.around(drawn.sets["own"]);
    d.add(u.pass, std::move(drawn));
  }
  return d.json();
}

/// Of the blocks whose word the workspace tells.
template <bool one_pass>
constexpr auto own_of_blocks = [](const scene_in_2d& s, const auto& workspace, unsigned pass, std::size_t k) {
  cell_blocks<2> blocks;
  blocks.shape(block_shape::parse(workspace.block()), one_pass);
  blocks.build(s.p.cells());
  return s.of_cells(blocks(pass, k));
};
constexpr auto own_cell = [](const scene_in_2d& s, const auto&, unsigned, std::size_t k) {
  return places{s.of_cell(k + 1)};
};

/// Three threads with fixed pieces of 32 cells: the copy each of them has, what it wrote there, and the cells it swept.
std::string private_copies() {
  struct threads_of_units : no_probe {
    std::vector<int> thread;
    void unit_begins(unsigned, std::size_t k) { thread[k] = omp_get_thread_num(); }
  };
  const square w;
  scene_in_2d s(w);
  const team three = team::omp(3).with({schedule::fixed, 32});
  thread_private::workspace<I> workspace;
  threads_of_units probe;
  probe.thread.assign(s.p.cells().fluid_cells, -1);
  workspace.prepare(s.p, three, probe);
  workspace.zero(s.p, three);
  workspace.sum(s.p, three, probe);
  drawing d("thread_private", w, s);
  for (std::size_t k = 0; k < workspace.copies.copies(); ++k) {
    drawn_unit drawn;
    const auto u = workspace.copies.with_copy(s.p, k).u;
    std::vector<std::uint32_t> written;
    for (std::uint32_t i = 0; i < s.p.fluid_count; ++i)
      if (u.load(i).neighbours != 0) written.push_back(i);
    drawn.sets["copy"] = s.of(written);
    for (std::size_t cell = 0; cell < probe.thread.size(); ++cell)
      if (probe.thread[cell] == static_cast<int>(k)) drawn.sets["own"].insert(s.of_cell(cell + 1));
    d.add(0, std::move(drawn));
  }
  return d.json();
}

/// A pass here is a copy; blocks of all run at the same time.
std::string pass_copies() {
  const square w;
  scene_in_2d s(w);
  per_pass_buffers::workspace<I> workspace;
  columns_trace trace;
  const team one = team::omp(1);
  workspace.prepare(s.p, one, trace);
  for (std::size_t k = 0; k < workspace.copies.copies(); ++k) {
    const auto u = workspace.copies.with_copy(s.p, k).u;
    zero_range(u, 0, s.p.fluid_count);
    trace.watch(u, s.p.fluid_count);
  }
  workspace.sum(s.p, one, trace);
  trace.close();
  drawing d("per_pass_buffers", w, s);
  for (const unit_record& u : trace.units)
    for (unsigned k = 0; k < workspace.copies.copies(); ++k)
      if (const auto& written = u.stretches[0].written[k]; !written.empty())
        d.add(k, {{{"own", {s.base(workspace.blocks[k][u.number])}}, {"copy", s.of(written)}}, {}});
  return d.json();
}

/// With so many particles that there are several pieces.
std::string buffered_blocks() {
  const square w{.cells = 12, .per_edge = 11};
  scene_in_2d s(w);
  touched_blocks::workspace<I> workspace;
  columns_trace trace;
  const team one = team::omp(1);
  workspace.prepare(s.p, one, trace);
  const auto buffer = workspace.buffer.pointers();
  const std::size_t size = workspace.block_size, slots = workspace.pieces.slots();
  zero_range(buffer, 0, slots * size);
  trace.watch(s.p.u, s.p.fluid_count);
  trace.watch(buffer, slots * size);
  workspace.sum(s.p, one, trace);
  trace.close();
  std::vector<std::size_t> block_of_slot(slots);
  for (std::size_t b = 0; b < workspace.pieces.blocks(); ++b)
    for (std::size_t slot = workspace.pieces.first_slot(b); slot < workspace.pieces.first_slot(b + 1); ++slot)
      block_of_slot[slot] = b;
  drawing d("touched_blocks", w, s);
  for (const unit_record& u : trace.units) {
    std::vector<std::uint32_t> in_buffer;
    for (const std::uint32_t at : u.stretches[0].written[1])
      in_buffer.push_back(static_cast<std::uint32_t>(block_of_slot[at / size] * size + at % size));
    const auto& piece = workspace.pieces[u.number];
    d.add(0, {{{"own", s.of_cells(piece.cell_begin, piece.cell_end)},
               {"rates", s.of(u.stretches[0].written[0])},
               {"copy", s.of(in_buffer)}},
              {}});
  }
  return d.json();
}

/// Slabs for three threads, one after the other.
std::string slabs_with_locks() {
  const square w;
  scene_in_2d s(w);
  sliced_workspace<I, traced_locks> workspace;
  columns_trace trace;
  workspace.locks.trace = &trace;
  workspace.prepare(s.p, team::omp(3), trace);
  trace.watch(s.p.u, s.p.fluid_count);
  workspace.sum(s.p, team::omp(1), sliced_locks::traits.loop, trace);
  trace.close();
  drawing d("sliced_locks", w, s);
  for (const unit_record& u : trace.units) {
    drawn_unit drawn;
    for (const stretch& part : workspace.slabs[u.number]) drawn.sets["own"].merge(s.of_cells(part.begin, part.end));
    for (const stretch_of_unit& part : u.stretches) {
      if (part.written.empty()) continue;
      const places written = s.of(part.written[0]);
      drawn.sets["rates"].insert(written.begin(), written.end());
      for (const std::int32_t lock : {part.low, part.high})
        if (lock >= 0 && !written.empty()) drawn.locks[lock].insert(written.begin(), written.end());
    }
    d.add(0, std::move(drawn));
  }
  return d.json();
}

/// Passes are the colours that orient the edges; units are numbered as blocks are.
std::string tasks() {
  const square w{.block = "brick:3"};
  scene_in_2d s(w);
  task_conflicts::workspace<I> workspace;
  configure(workspace, s.world);
  columns_trace trace;
  with_one_thread(runtime::tbb, [&](const team& one) {
    workspace.prepare(s.p, one, trace);
    trace.watch(s.p.u, s.p.fluid_count);
    workspace.sum(s.p, one, trace);
  });
  trace.close();
  const std::vector<block_pair> conflicts = conflicts_of(s.p.cells(), workspace.blocks);
  const std::vector<unsigned> colour = colours_for(workspace.blocks.size(0), conflicts);
  std::ranges::sort(trace.units, {}, &unit_record::number);
  std::vector<std::pair<unsigned, std::uint32_t>> by_colour;
  for (std::uint32_t k = 0; k < trace.units.size(); ++k) by_colour.emplace_back(colour[k], k);
  std::ranges::sort(by_colour);
  std::vector<std::uint32_t> at(by_colour.size());  // where a task is drawn
  for (std::uint32_t k = 0; k < by_colour.size(); ++k) at[by_colour[k].second] = k;
  drawing d("task_conflicts", w, s, workspace.block());
  for (const auto& [own_colour, k] : by_colour)
    d.add(own_colour,
          {{{"own", s.of_cells(workspace.blocks(0, k))}, {"rates", s.of(trace.units[k].stretches[0].written[0])}}, {}});
  std::vector<block_pair> edges;
  for (const auto& [a, b] : conflicts) edges.emplace_back(std::min(at[a], at[b]), std::max(at[a], at[b]));
  d.edges(edges);
  return d.json();
}

std::vector<std::string> all() {
  const square plain, seam{.cells = 8, .grid = "hashed_grid", .M = 3};
  const auto coloured_cell = [](const scene_in_2d& s, const auto& w, unsigned pass, std::size_t k) {
    return places{s.of_cell(w.by_colour[pass][k])};
  };
  const auto half_base = [](const scene_in_2d& s, const auto& w, unsigned pass, std::size_t k) {
    const auto unit = w.blocks(pass, k);
    place at = s.base(*unit.cells);
    for (int d = 0; d < 2; ++d) at[d] = 2 * at[d] + static_cast<int>(unit.part >> d & 1);
    return places{at};
  };
  const auto packed_bases = [](const scene_in_2d& s, const auto& w, unsigned pass, std::size_t k) {
    places found;
    for (std::size_t b = w.packs(pass, k).begin; b < w.packs(pass, k).end; ++b)
      found.insert(s.base(w.packs.blocks()[b]));
    return found;
  };
  return {units<naive_omp>(plain, own_cell),
          units<naive_tiles_omp>({.block = "brick:4"}, own_of_blocks<true>),
          units<sphysics_sweep>(plain, own_cell),
          units<ppm_stencil>(plain, [](const scene_in_2d& s, const auto& w, unsigned,
                                       std::size_t k) { return places{s.base(w.blocks[k])}; }),
          units<symmetric_omp>(plain, [](const scene_in_2d& s, const auto& w, unsigned pass,
                                         std::size_t k) { return places{s.base(w.blocks[pass][k])}; }),
          units<tiles_omp>({.block = "brick:2"}, own_of_blocks<false>),
          units<colour18>(plain, coloured_cell),
          units<colour18>(seam, coloured_cell, "colour18_seam"),
          units<colour4>({.cells = 16}, packed_bases),
          units<half_cells>(plain, half_base, "half_cells", 2),
          units<half_cells>(seam, half_base, "half_cells_seam", 2),
          units<pair_list_omp>({.block = "slab:2"}, own_of_blocks<false>),
          units<verlet_list>({.block = "slab:2", .skin = verlet_list::traits.skin}, own_of_blocks<false>),
          units<sliced_2colour>(plain,
                                [](const scene_in_2d& s, const auto& w, unsigned pass, std::size_t k) {
                                  return s.of_cells(w.slabs[pass][k].begin, w.slabs[pass][k].end);
                                }),
          slabs_with_locks(),
          tasks(),
          units<atomic_add>(plain, own_cell),
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
