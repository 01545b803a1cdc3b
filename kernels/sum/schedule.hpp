#pragma once
#include <memory>
#include <string>

#include <pairsum/core/pass_observer.hpp>
#include <pairsum/core/precision.hpp>
#include <pairsum/sum/backend_traits.hpp>
#include <pairsum/sum/problem.hpp>
#include <pairsum/sum/setup.hpp>

namespace pairsum {

struct any_schedule {
  virtual ~any_schedule() = default;
};

/// The same object, as its own type; std::bad_cast if it is of another.
template <class To, class From>
std::unique_ptr<To> cast(std::unique_ptr<From> from) {
  To& to = dynamic_cast<To&>(*from);
  (void)from.release();
  return std::unique_ptr<To>(&to);
}

/// A summation algorithm: which particles meet when, and where their rates go. It cuts the sum into units of work by
/// colours: units of a colour run at the same time, on any thread, and write to different particles; between colours
/// there is a barrier. It is kept from step to step and does not time, print, or know the formula. A schedule has
/// `static constexpr backend_traits traits` without name and runtime, and PAIRSUM_BACKEND makes a backend of it.
template <int D, class R>
class schedule : public any_schedule {
 public:
  using problem_type = problem<D, R>;

  /// Reads the options, before there are particles. `cell_bytes`: what a sum touches of a cell's particles at the
  /// talk's spacing of H/2. Throws pairsum::error for what is unavailable.
  virtual void configure(const setup&, std::size_t /*cell_bytes*/) {}
  /// Refreshes its own buffers, lists, colours (timed apart).
  virtual void prepare(const problem_type&, const team&) {}
  /// The rates to 0.
  virtual void zero(const problem_type& p, const team& t) {
    if (p.is_zero) return;
    t.for_pieces(p.fluid_count,
                 [&](std::size_t begin, std::size_t end, std::size_t) { p.pairs->zero(p.u, begin, end); });
  }
  virtual unsigned colours(const problem_type&) const { return 1; }
  /// Units of a colour.
  virtual std::size_t size(const problem_type& p, unsigned colour) const = 0;
  /// Sums unit k of a colour, on thread `thread` of the team.
  virtual void unit(const problem_type& p, unsigned colour, std::size_t k, int thread) = 0;
  /// All units, on the runtime that the traits name. Overridden by algorithms with a runtime of their own.
  virtual void sum(const problem_type& p, const team& t, const backend_traits& own, const pass_marks& marks);
  /// Adds up private copies.
  virtual void reduce(const problem_type&, const team&) {}

  /// For Verlet lists (traits.skin > 0): do they still contain every pair within the cutoff? Particles and their order
  /// must be those of the last prepare().
  virtual bool outlasts(const problem_type&, const team&) const { return false; }
  /// The particles are, or may be, others, or in another order.
  virtual void expire() {}
  /// The blocks of cells as made last, as a word of block_shape; "none" without blocks.
  virtual std::string block() const { return "none"; }
};

#define PAIRSUM_SCHEDULES(D, R) extern template class schedule<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_SCHEDULES)
#undef PAIRSUM_SCHEDULES

/// Makes a schedule<dim, single ? float : double>.
using schedule_maker = std::unique_ptr<any_schedule> (*)(int dim, bool single);

/// A backend of a registry.
struct backend_entry {
  backend_traits traits;
  schedule_maker make;
  std::string unavailable = {};  ///< why it cannot be used, empty if it can

  /// The backend `word` that runs schedule S on runtime r; `word` must live for ever.
  template <template <int, class> class S>
  static backend_entry of(std::string_view word, runtime r) {
    return {S<3, double>::traits.on(word, r), [](int dim, bool single) {
              return at_place(dim, single, []<int D, class R>() -> std::unique_ptr<any_schedule> {
                return std::make_unique<S<D, R>>();
              });
            }};
  }
};

}  // namespace pairsum

/// The backend `word`: schedule `algorithm` on runtime `on` (serial, omp, tbb).
#define PAIRSUM_BACKEND(word, algorithm, on)                                        \
  namespace pairsum::backends {                                                     \
  backend_entry word() { return backend_entry::of<algorithm>(#word, runtime::on); } \
  }
