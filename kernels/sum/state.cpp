#include "sum/state.hpp"

#include "sum/check.hpp"
#include "sum/grids.hpp"

namespace pairsum {

template <int D, class R>
state<D, R>::state(const setup& s) : setup_((check_world(s), s)), index_(make_box<D, R>(s), make_grid<D, R>(s)) {}

template <int D, class R>
state<D, R>::~state() = default;

template <int D, class R>
void state<D, R>::load(const particle_table& p, const std::vector<std::uint32_t>& order) {
  check(p);
  check_order(order, p.size());
  fill(particles_, p, order);
  rows_ = p.size();
  lost_ = 0;
}

template <int D, class R>
void state<D, R>::check(const particle_table& p) const {
  check_input(p, setup_);
}

template <int D, class R>
void state<D, R>::index(const team& t) {
  index_.build(particles_, t);
  lost_ += index_.lost();
}

template <int D, class R>
particle_table state<D, R>::snapshot() const {
  return to_table(particles_, rows_);
}

PAIRSUM_STATES()

}  // namespace pairsum
