#pragma once
#include <memory>
#include <optional>

#include <pairsum/core/isa.hpp>
#include <pairsum/sum/schedule.hpp>
#include <pairsum/sum/state.hpp>

namespace pairsum {

/// A schedule with a formula: the one implementation of `summation`.
template <int D, class R>
class summation_in final : public state<D, R> {
  using base = state<D, R>;

 public:
  /// Throws pairsum::error for an isa or a block that is unavailable.
  summation_in(const setup& s, const backend_traits& traits, schedule_maker make, std::unique_ptr<formula<D, R>> f);

  const backend_traits& traits() const override { return traits_; }
  void check(const particle_table& p) const override;
  using summation::load;
  void load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) override;
  void index(const team& t) override;
  void prepare(const team& t) override;
  void zero(const team& t) override;
  void sum(const team& t) override;
  void reduce(const team& t) override;
  work_counts count_work() override;
  std::string block() const override { return schedule_->block(); }
  std::size_t lanes() const override { return lane_ == nullptr ? 1 : lane_->lanes; }
  std::string_view isa() const override { return lane_ == nullptr ? scalar_isa : lane_->isa; }
  rate_table rates() const override;
  std::uint64_t fingerprint() const override;
  dynamics<D, R> rates_of_state() const override { return formula_->rates_of_state(); }
  rate_columns columns_of_rates() const override {
    return {view_.columns, formula_->scalar().rate_bytes, formula_->scalar().add};
  }

  /// The schedule, for tests.
  const schedule<D, R>& inner() const { return *schedule_; }

 private:
  std::unique_ptr<schedule<D, R>> new_schedule() const;
  void choose_lanes();
  std::size_t cell_bytes() const;
  void check_kind(const team& t) const;
  problem<D, R> bare() const;

  backend_traits traits_;
  schedule_maker make_;
  std::unique_ptr<formula<D, R>> formula_;
  const lane_sum<D, R>* lane_ = nullptr;  ///< nullptr: scalar
  const vector_lister<D>* lister_ = nullptr;
  std::optional<lane_rows<D, R>> rows_;
  std::unique_ptr<schedule<D, R>> schedule_;
  torus<D, R> omega_;
  problem<D, R> view_{};
};

#define PAIRSUM_SUMMATIONS(D, R) extern template class summation_in<D, R>;
PAIRSUM_EACH_D_R(PAIRSUM_SUMMATIONS)
#undef PAIRSUM_SUMMATIONS

}  // namespace pairsum
