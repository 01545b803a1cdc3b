#pragma once
#include <map>
#include <set>
#include <string>

#include "harness/rows/row.hpp"

namespace pairsum::harness {

/// Names that tell points apart beside M and threads: the backend's, with the grid unless that is hashed_grid, and with
/// isa, block and granularity where the backend has several of them among the points that were added.
class variant_names {
 public:
  void add(const point& p) {
    seen& s = seen_[p.backend];
    s.isas.insert(p.isa);
    s.blocks.insert(p.block);
    s.granularities.insert(p.granularity);
  }

  std::string operator()(const point& p) const {
    std::string name = p.grid == "hashed_grid" || p.grid.empty() ? p.backend : p.backend + "/" + p.grid;
    return name + rest(p);
  }
  /// The same without the grid.
  std::string without_grid(const point& p) const { return p.backend + rest(p); }

 private:
  struct seen {
    std::set<std::string> isas, blocks, granularities;
  };

  std::string rest(const point& p) const {
    const auto at = seen_.find(p.backend);
    if (at == seen_.end()) return {};
    std::string text;
    if (at->second.isas.size() > 1) text += " " + p.isa;
    if (at->second.blocks.size() > 1) text += " " + p.block;
    if (at->second.granularities.size() > 1) text += " " + p.granularity;
    return text;
  }

  std::map<std::string, seen> seen_;
};

}  // namespace pairsum::harness
