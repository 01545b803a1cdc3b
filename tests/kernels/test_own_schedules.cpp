#include <gtest/gtest.h>

#include <pairsum/core/isa.hpp>
#include <pairsum/schedule/cell_sweep.hpp>
#include <pairsum/sum/rate_copies.hpp>
#include "library_formulas.hpp"
#include "scene.hpp"

// What the contract promises to schedules of one's own, on every instruction set.
namespace pairsum {
namespace {

using namespace test_kit;

/// A half-stencil sweep into a copy of the rates, which then takes their place: what went elsewhere is lost.
template <int D, class R>
class into_a_copy final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{};
  void prepare(const P& p, const team&) override { copies_.resize(2, p); }
  void zero(const P& p, const team&) override { p.pairs->zero(copies_.of(p, 1), 0, p.rate_rows()); }
  std::size_t size(const P& p, unsigned) const override { return p.cells().fluid_cells; }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    const auto cell = static_cast<std::uint32_t>(k + 1);
    sum_cells(p, {.u = copies_.of(p, 1), .thread = thread}, partners::later, &cell, 1);
  }
  void reduce(const P& p, const team& t) override {
    p.pairs->zero(p.u, 0, p.fluid_count);
    copies_.join(p, t);
  }

 private:
  rate_copies<D, R> copies_;
};

/// Adds atomically without saying so.
template <int D, class R>
class adds_atomically final : public schedule<D, R> {
  using P = problem<D, R>;

 public:
  static constexpr backend_traits traits{};
  std::size_t size(const P& p, unsigned) const override { return p.cells().fluid_cells; }
  void unit(const P& p, unsigned, std::size_t k, int thread) override {
    sweep_cell_in_order(p, k + 1, {.u = p.u, .how = update::atomic, .thread = thread});
  }
};

std::unique_ptr<summation> sum_of(const backend_entry& b, const scene& s, std::string_view isa) {
  registry own;
  own.add(b);
  own.add(ferrari09_3d());
  setup world = with(s.world, b.traits.name, 4);
  world.isa = isa;
  auto sum = own.make_summation(world);
  sum->load(s.particles, {});
  return sum;
}

TEST(own_schedules, sum_cells_adds_to_a_copy_of_the_rates_on_every_instruction_set) {
  const scene s = make_scene("dam_break", 0.055, "perturbed");
  const auto oracle = registry::instance().make_reference(with(s.world, "naive", 4));
  const expectation e = oracle->brute_force(s.particles, some_threads());
  std::vector<std::string> isas{std::string(scalar_isa)};
  for (const std::string_view isa : isa_names()) isas.emplace_back(isa);
  for (const std::string& isa : isas) {
    const auto sum = sum_of(backend_entry::of<into_a_copy>("into_a_copy", runtime::serial), s, isa);
    sum->evaluate(team());
    EXPECT_EQ(disagreement(sum->rates(), e), "") << isa;
  }
}

TEST(own_schedules, atomic_additions_without_their_trait_are_refused_on_vector_units) {
  if (isa_names().empty()) GTEST_SKIP() << "no vector units";
  const scene s = make_scene("dam_break", 0.1, "rest");
  const auto sum = sum_of(backend_entry::of<adds_atomically>("adds_atomically", runtime::serial), s, best_isa);
  try {
    sum->evaluate(team());
    FAIL() << "it summed";
  } catch (const error& e) {
    EXPECT_NE(std::string(e.what()).find("conflict_avoidance::atomics"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace pairsum
