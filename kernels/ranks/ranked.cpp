#include <pairsum/ranks/ranked.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>
#include <optional>

#include <mpi.h>

#include <pairsum/core/error.hpp>
#include <pairsum/integrators/with_state.hpp>
#include <pairsum/ranks/domain.hpp>
#include <pairsum/sum/check.hpp>

namespace pairsum::ranks {
namespace {

/// All ranks' elements, those of rank 0 first, on every rank.
template <class T>
std::vector<T> gathered(const std::vector<T>& own) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Datatype element;
  MPI_Type_contiguous(sizeof(T), MPI_BYTE, &element);
  MPI_Type_commit(&element);
  const int n = static_cast<int>(own.size());
  std::vector<int> sizes(static_cast<std::size_t>(ranks)), begins(sizes.size(), 0);
  MPI_Allgather(&n, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::exclusive_scan(sizes.begin(), sizes.end(), begins.begin(), 0);
  std::vector<T> all(static_cast<std::size_t>(begins.back()) + static_cast<std::size_t>(sizes.back()));
  MPI_Allgatherv(own.data(), n, element, all.data(), sizes.data(), begins.data(), element, MPI_COMM_WORLD);
  MPI_Type_free(&element);
  return all;
}

std::uint64_t total(std::uint64_t own) {
  MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return own;
}

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
    const auto ids = domain_.own_ids();
    const auto all_ids = gathered(ids);
    for (std::size_t c = 0; c < own.columns.size(); ++c) {
      std::vector<double> some;
      for (const std::uint32_t id : ids) some.push_back(own.columns[c][id]);
      const auto column = gathered(some);
      for (std::size_t k = 0; k < all_ids.size(); ++k) all.columns[c][all_ids[k]] = column[k];
    }
    return all;
  }
  std::uint64_t fingerprint() const override {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const auto& column : rates().columns)
      for (const double a : column) {
        std::uint64_t word;
        std::memcpy(&word, &a, sizeof a);
        hash = (hash ^ word) * 0x100000001b3u;
        hash ^= hash >> 29;
      }
    return hash;
  }
  particle_table snapshot() const override {
    const particle_table own = local_->snapshot();
    particle_table all = boundary_;
    const auto ids = domain_.own_ids();
    const auto all_ids = gathered(ids);
    const auto take = [&](const std::vector<double>& from, std::vector<double>& to) {
      std::vector<double> some;
      for (const std::uint32_t id : ids) some.push_back(from[id]);
      const auto column = gathered(some);
      for (std::size_t k = 0; k < all_ids.size(); ++k) to[all_ids[k]] = column[k];
    };
    for (std::size_t d = 0; d < own.x.size(); ++d) {
      take(own.x[d], all.x[d]);
      take(own.v[d], all.v[d]);
    }
    take(own.rho, all.rho);
    take(own.m, all.m);
    std::vector<particle_kind> kinds;
    for (const std::uint32_t id : ids) kinds.push_back(own.kind[id]);
    kinds = gathered(kinds);
    for (std::size_t k = 0; k < all_ids.size(); ++k) all.kind[all_ids[k]] = kinds[k];
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
