#include <pairsum/sum/summation_in.hpp>

#include <algorithm>

#include <pairsum/core/names.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/sum/grids.hpp>
#include <pairsum/sum/no_formula.hpp>
#include <pairsum/sum/omega.hpp>
#include <pairsum/sum/vector_lister.hpp>

namespace pairsum {

template <int D, class R>
summation_in<D, R>::summation_in(const setup& s, const backend_traits& traits, schedule_maker make,
                                 std::unique_ptr<formula<D, R>> f)
    : base(s, traits.skin),
      traits_(traits),
      make_(make),
      formula_(std::move(f)),
      omega_(make_torus<D, R>(s, traits.skin)) {
  choose_lanes();
  schedule_ = new_schedule();
}

/// The vector units that the setup asks for; none for formulas with whole numbers.
template <int D, class R>
void summation_in<D, R>::choose_lanes() {
  const setup& s = this->setup_;
  const bool mixed = formula_->layout().mixed;
  std::string isa = s.isa;
  if (isa == default_isa) isa = traits_.vector || mixed ? best_isa : scalar_isa;
  check_isa(isa);
  if (isa != scalar_isa) {
    if (traits_.conflicts == conflict_avoidance::atomics)
      throw error("backend " + std::string(traits_.name) +
                  " does not run on vector units, whose lanes cannot add atomically: use isa " +
                  std::string(scalar_isa));
    const auto built = formula_->lanes();
    const auto listers = vector_listers<D>();
    for (const lane_sum<D, R>& sum : built)
      for (const vector_lister<D>& lister : listers)
        if (lane_ == nullptr && sum.isa == lister.isa && (isa == best_isa || isa == sum.isa)) {
          lane_ = &sum;
          lister_ = &lister;
        }
    if (lane_ == nullptr && built.empty() && isa != best_isa)
      throw error("interaction " + s.interaction + " sums whole numbers, which vector units do not: use isa " +
                  std::string(scalar_isa));
    if (lane_ == nullptr && !built.empty())
      throw error("interaction " + s.interaction + " was not compiled for isa " + isa +
                  "; an interaction of your own is compiled for the set that its source's flags name: use isa " +
                  std::string(best_isa));
  }
  if (lane_ != nullptr) {
    rows_.emplace(s, formula_->layout(), lane_->fuses, traits_.skin);
  } else if (mixed) {
    throw error("precision mixed needs vector units: use an isa other than " + std::string(scalar_isa) +
                (isa_names().empty() ? ", in a build and on a machine that have one" : ""));
  }
}

template <int D, class R>
std::unique_ptr<schedule<D, R>> summation_in<D, R>::new_schedule() const {
  auto untyped = make_(D, std::is_same_v<R, float>);
  if (untyped == nullptr)
    throw error("backend " + std::string(traits_.name) + " was not compiled for " + std::to_string(D) + "D in " +
                std::string(precision_name<R>()) + ": see PAIRSUM_DIMS and PAIRSUM_PRECISIONS of its library");
  auto made = cast<schedule<D, R>>(std::move(untyped));
  made->configure(this->setup_, cell_bytes());
  return made;
}

/// What a sum touches of a cell's particles, at the talk's spacing of H/2.
template <int D, class R>
std::size_t summation_in<D, R>::cell_bytes() const {
  const lane_layout layout = formula_->layout();
  const std::size_t particle = lane_ != nullptr ? layout.stride + D * sizeof(std::int32_t) : layout.column_bytes;
  return (std::size_t{1} << D) * particle;
}

template <int D, class R>
void summation_in<D, R>::check(const particle_table& p) const {
  base::check(p);
  formula_->check(p, this->setup_);
}

template <int D, class R>
void summation_in<D, R>::load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) {
  base::load(p, order, t);
  view_ = {};
}

template <int D, class R>
void summation_in<D, R>::check_kind(const team& t) const {
  const bool fits = traits_.threads == runtime::tbb ? t.kind() == runtime::tbb
                                                    : t.kind() != runtime::tbb || traits_.threads == runtime::serial;
  if (!fits)
    throw error("backend " + std::string(traits_.name) + " sums with a team of " +
                std::string(name_of(traits_.threads)) + " threads, got one of " + std::string(name_of(t.kind())));
}

/// For a schedule that keeps lists: nothing, as long as they serve.
template <int D, class R>
void summation_in<D, R>::index(const team& t) {
  if (traits_.skin > 0) {
    const bool same = view_.grid_cells != nullptr && this->index_.holds(this->particles_, t);
    if (same && schedule_->outlasts(view_, t)) return;
    schedule_->expire();
  }
  base::index(t);
}

/// The particles as indexed last, without a formula.
template <int D, class R>
problem<D, R> summation_in<D, R>::bare() const {
  const R H = static_cast<R>(this->setup_.constants.H);
  problem<D, R> p{};
  for (int d = 0; d < D; ++d) p.x.column[d] = this->particles_.x[d].data();
  p.x.omega = omega_;
  p.reach2 = H * H;
  p.grid_cells = &this->index_.view();
  p.fluid_count = this->index_.fluid();
  p.count = p.fluid_count + this->index_.boundary();
  p.ghosts = this->ghosts_.any() ? &this->ghosts_ : nullptr;
  return p;
}

template <int D, class R>
void summation_in<D, R>::prepare(const team& t) {
  check_kind(t);
  const auto& particles = this->particles_;
  formula_->derive(particles, this->index_.fluid(), this->index_.boundary(), t, lane_ == nullptr);
  view_ = bare();
  formula_->open(view_, static_cast<R>(this->setup_.constants.H));
  view_.threads = t.threads();
  if (lane_ != nullptr) {
    rows_->prepare(view_, t);
    t.for_pieces(view_.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
      formula_->fill(particles, rows_->view(), begin, end);
    });
    view_.pairs = &lane_->pairs;
    view_.lanes = lister_;
  }
  schedule_->prepare(view_, t);
}

template <int D, class R>
void summation_in<D, R>::zero(const team& t) {
  check_kind(t);
  if (traits_.symmetric) {
    schedule_->zero(view_, t);
  } else if (lane_ != nullptr) {  // gathers add to the columns
    t.for_pieces(view_.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
      formula_->scalar().zero(view_.columns, begin, end);
    });
  }
}

template <int D, class R>
void summation_in<D, R>::sum(const team& t) {
  check_kind(t);
  check_prepared(view_.threads, t);
  view_.is_zero = false;
  schedule_->sum(view_, t, traits_, pass_marks(this->observer_));
}

template <int D, class R>
void summation_in<D, R>::reduce(const team& t) {
  check_kind(t);
  schedule_->reduce(view_, t);
  if (lane_ != nullptr && traits_.symmetric)
    t.for_pieces(view_.fluid_count, [&](std::size_t begin, std::size_t end, std::size_t) {
      lane_->to_columns(view_.u, view_.columns, begin, end);
    });
}

/// All loops once more, on one thread and without a formula. Boundary counts as far as the cutoff, whatever the
/// formula.
template <int D, class R>
work_counts summation_in<D, R>::count_work() {
  const auto made = new_schedule();
  work_counts counts;
  problem<D, R> p = bare();
  p.boundary_reach2 = p.reach2;
  p.pairs = &no_formula<D, R>();
  p.counts = &counts;
  const workers one(traits_.threads, 1);
  made->prepare(p, one.get());
  made->sum(p, one.get(), traits_, pass_marks());
  counts.cells = p.cells().total;
  counts.cells_nonempty = p.cells().nonempty();
  return counts;
}

template <int D, class R>
rate_table summation_in<D, R>::rates() const {
  return formula_->rates(this->particles_.id, view_.fluid_count, this->rows_total_);
}

template <int D, class R>
std::uint64_t summation_in<D, R>::fingerprint() const {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(this->rows_total_, none);
  for (std::uint32_t i = 0; i < view_.fluid_count; ++i) place[this->particles_.id[i]] = i;
  std::erase(place, none);
  return formula_->fingerprint(place);
}

#define PAIRSUM_SUMMATIONS(D, R) template class summation_in<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_SUMMATIONS)

}  // namespace pairsum
