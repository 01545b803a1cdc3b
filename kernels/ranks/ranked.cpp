#include <pairsum/ranks/ranked.hpp>

#include <algorithm>
#include <functional>
#include <optional>

#include <mpi.h>

#include <pairsum/core/error.hpp>
#include <pairsum/core/word_hash.hpp>
#include <pairsum/integrators/with_state.hpp>
#include <pairsum/ranks/domain.hpp>
#include <pairsum/ranks/gathered.hpp>
#include <pairsum/sum/check.hpp>

namespace pairsum::ranks {
namespace {

std::uint64_t total(std::uint64_t own) {
  MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return own;
}

/// Rows of tables in id order, each of which one rank has.
class rows_of_all {
 public:
  explicit rows_of_all(std::vector<std::uint32_t> own_ids) : own_(std::move(own_ids)), all_(gathered(own_)) {}

  /// Takes a column's rows of every rank from that rank's table.
  template <class T>
  void take(const std::vector<T>& from, std::vector<T>& to) const {
    std::vector<T> own;
    for (const std::uint32_t id : own_) own.push_back(from[id]);
    const std::vector<T> column = gathered(own);
    for (std::size_t k = 0; k < all_.size(); ++k) to[all_[k]] = column[k];
  }

 private:
  std::vector<std::uint32_t> own_, all_;
};

/// What the rest of this file needs of a domain, whatever its dimension and precision.
struct any_domain {
  std::function<void(const particle_table&, const std::vector<std::uint32_t>&)> load;
  std::function<void(bool cut_anew)> before_index;
  std::function<void()> send_back;
  std::function<rank_facts()> facts;
  std::function<std::vector<std::uint32_t>()> own_ids;
};

class ranked_summation final : public summation {
 public:
  ranked_summation(std::unique_ptr<summation> s, const options& o) : local_(std::move(s)), options_(o) {
    with_state(*local_, [&]<int D, class R>(state<D, R>& st) {
      st.sum_ghosts(options_.pairs);
      const double H = st.settings().constants.H;
      auto d = std::make_shared<domain<D, R>>(st, H, H * std::max(options_.skin, local_->traits().skin));
      domain_.load = [d, this](const particle_table& p, const std::vector<std::uint32_t>& order) {
        d->load(p, order, options_.weights);
      };
      domain_.before_index = [d, this](bool cut_anew) {
        if (cut_anew) d->cut(options_.weights);
        d->update();
      };
      domain_.send_back = [d] { d->send_back(); };
      domain_.facts = [d, &st] {
        rank_facts f = d->sent();
        f.own = d->own();
        f.ghosts = d->ghosts();
        f.boundary = st.boundary_count();
        return f;
      };
      domain_.own_ids = [&st] {
        std::vector<std::uint32_t> ids;
        const auto& p = st.particles();
        for (std::size_t i = 0; i < p.size(); ++i)
          if (p.kind[i] == particle_kind::fluid || p.kind[i] == particle_kind::lost) ids.push_back(p.id[i]);
        return ids;
      };
    });
  }

  const backend_traits& traits() const override { return local_->traits(); }
  void check(const particle_table& p) const override { local_->check(p); }
  using summation::load;
  void load(const particle_table& p, const std::vector<std::uint32_t>& order, const team&) override {
    check(p);
    check_order(order, p.size());
    rows_ = p.size();
    boundary_ = p;
    for (auto& kind : boundary_.kind)
      if (kind == particle_kind::fluid) kind = particle_kind::lost;
    domain_.load(p, order);
    sums_ = 0;
  }
  void index(const team& t) override {
    const bool anew = options_.partition_every > 0 && sums_ > 0 && sums_ % options_.partition_every == 0;
    if (sums_ > 0) facts_ = {}, domain_.facts();  // those of the load belong to the first
    ++sums_;
    domain_.before_index(anew);
    local_->index(t);
  }
  void prepare(const team& t) override { local_->prepare(t); }
  void zero(const team& t) override { local_->zero(t); }
  void sum(const team& t) override { local_->sum(t); }
  void reduce(const team& t) override {
    local_->reduce(t);
    if (options_.pairs == cut_pairs::once) domain_.send_back();
  }
  void observe(pass_observer* observer) override { local_->observe(observer); }

  work_counts count_work() override {
    work_counts w = local_->count_work();
    const auto add = [](std::uint64_t& n) { n = total(n); };
    for (std::uint64_t* n : {&w.cells_nonempty, &w.sumF1, &w.sumF2, &w.pairs_tested, &w.pairs_fluid_fluid,
                             &w.pairs_fluid_boundary, &w.pairs_cut, &w.pairs_evaluated})
      add(*n);
    for (std::uint64_t& n : w.vectors) add(n);
    if (options_.pairs == cut_pairs::twice) {
      w.pairs_cut /= 2;
      w.pairs_fluid_fluid -= w.pairs_cut;
    }
    return w;
  }
  std::string block() const override { return local_->block(); }
  std::size_t lanes() const override { return local_->lanes(); }
  std::string_view isa() const override { return local_->isa(); }
  std::optional<unfolded_tests> count_unfolded_tests() const override { return std::nullopt; }

  rate_table rates() const override {
    const rate_table own = local_->rates();
    rate_table all{own.names, {}};
    all.columns.assign(own.columns.size(), std::vector<double>(rows_, 0.0));
    const rows_of_all rows(domain_.own_ids());
    for (std::size_t c = 0; c < own.columns.size(); ++c) rows.take(own.columns[c], all.columns[c]);
    return all;
  }
  std::uint64_t fingerprint() const override {
    word_hash hash;
    for (const auto& column : rates().columns)
      for (const double a : column) hash.add(a);
    return hash.value();
  }
  particle_table snapshot() const override {
    const particle_table own = local_->snapshot();
    particle_table all = boundary_;
    const rows_of_all rows(domain_.own_ids());
    for (std::size_t d = 0; d < own.x.size(); ++d) {
      rows.take(own.x[d], all.x[d]);
      rows.take(own.v[d], all.v[d]);
    }
    rows.take(own.rho, all.rho);
    rows.take(own.m, all.m);
    rows.take(own.kind, all.kind);
    return all;
  }
  std::size_t lost() const override { return total(local_->lost()); }
  std::vector<std::uint32_t> not_finite() const override {
    auto ids = gathered(local_->not_finite());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }
  summation& holder() override { return local_->holder(); }

  rank_facts own_facts() {
    const rank_facts before = facts_;
    rank_facts& f = facts_ = domain_.facts();
    for (traffic rank_facts::*phase :
         {&rank_facts::halo, &rank_facts::migrate, &rank_facts::send_back, &rank_facts::partition}) {
      (f.*phase).messages += (before.*phase).messages;
      (f.*phase).bytes += (before.*phase).bytes;
    }
    const work_counts w = local_->count_work();
    f.pairs = w.pairs_fluid_fluid + w.pairs_fluid_boundary;
    f.cut = w.pairs_cut;
    return f;
  }

 private:
  std::unique_ptr<summation> local_;
  options options_;
  any_domain domain_;
  std::size_t rows_ = 0;
  particle_table boundary_;  ///< for snapshots; all other rows are lost
  rank_facts facts_;
  int sums_ = 0;
};

}  // namespace

std::unique_ptr<summation> make_ranked(std::unique_ptr<summation> s, const options& o) {
  return std::make_unique<ranked_summation>(std::move(s), o);
}

std::vector<rank_facts> facts_of(summation& s) {
  auto* const ranked = dynamic_cast<ranked_summation*>(&s);
  if (ranked == nullptr) throw error("facts of ranks need a summation of make_ranked()");
  return gathered(std::vector<rank_facts>{ranked->own_facts()});
}

}  // namespace pairsum::ranks
