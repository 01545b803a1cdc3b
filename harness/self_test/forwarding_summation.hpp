#pragma once
#include <memory>
#include <string_view>
#include <utility>

#include <pairsum/sum/summation.hpp>

namespace pairsum::harness {

/// Another summation under its own name: every call goes on to that one. What is different is overridden.
class forwarding_summation : public summation {
 public:
  /// `name` and `description` must live for ever.
  forwarding_summation(std::unique_ptr<summation> inner, std::string_view name, std::string_view description)
      : inner_(std::move(inner)), traits_(inner_->traits()) {
    traits_.name = name;
    traits_.description = description;
  }

  const backend_traits& traits() const override { return traits_; }
  void check(const particle_table& p) const override { inner_->check(p); }
  using summation::load;
  void load(const particle_table& p, const std::vector<std::uint32_t>& order, const team& t) override {
    inner_->load(p, order, t);
  }
  void index(const team& t) override { inner_->index(t); }
  void prepare(const team& t) override { inner_->prepare(t); }
  void zero(const team& t) override { inner_->zero(t); }
  void sum(const team& t) override { inner_->sum(t); }
  void reduce(const team& t) override { inner_->reduce(t); }
  void observe(pass_observer* observer) override { inner_->observe(observer); }
  std::optional<unfolded_tests> count_unfolded_tests() const override { return inner_->count_unfolded_tests(); }
  std::string block() const override { return inner_->block(); }
  std::size_t lanes() const override { return inner_->lanes(); }
  std::string_view isa() const override { return inner_->isa(); }
  work_counts count_work() override { return inner_->count_work(); }
  rate_table rates() const override { return inner_->rates(); }
  std::uint64_t fingerprint() const override { return inner_->fingerprint(); }
  particle_table snapshot() const override { return inner_->snapshot(); }
  std::size_t lost() const override { return inner_->lost(); }
  std::vector<std::uint32_t> not_finite() const override { return inner_->not_finite(); }
  summation& holder() override { return inner_->holder(); }

 private:
  std::unique_ptr<summation> inner_;
  backend_traits traits_;
};

}  // namespace pairsum::harness
