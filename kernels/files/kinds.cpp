// Which particles of files are fluid and which boundary.
#include <algorithm>
#include <set>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/set_in_making.hpp>
#include <pairsum/files/words.hpp>

namespace pairsum::files {
namespace {

/// What --boundary-kind does to a set, and whether it is about anything there.
class rule_use {
 public:
  explicit rule_use(const std::optional<boundary_rule>& rule) : rule_(rule) {
    if (rule) used_.resize(rule->values.size());
  }

  void apply(one_file& f) {
    const auto column = f.content.others.find(rule_->column);
    if (column != f.content.others.end()) return by_column(f, column->second);
    if (!rule_->names_groups() || f.content.groups.empty())
      throw error(f.name() + " has no column " + rule_->column + ", which --boundary-kind names");
    for (const std::string& group : f.content.groups) {
      there_.insert(group);
      for (std::size_t k = 0; k < used_.size(); ++k)
        if (boundary_rule{rule_->column, {rule_->values[k]}}.takes(group)) used_[k] = true;
    }
  }

  /// Throws where no value is there, and tells of those that are not.
  void check(set_in_making& s) const {
    if (there_.empty()) return;
    std::string unused;
    for (std::size_t k = 0; k < used_.size(); ++k)
      if (!used_[k]) unused += (unused.empty() ? "" : ", ") + rule_->values[k];
    if (std::ranges::find(used_, true) == used_.end())
      throw error("--boundary-kind is \"" + s.told.boundary_kind + "\", but " + s.named() + " has the " +
                  (rule_->names_groups() ? "groups " : "values ") + join(std::vector(there_.begin(), there_.end())) +
                  (there_.size() == most_told ? ", ..." : ""));
    if (!unused.empty()) s.tell("kinds not there", unused, origin::given, "--boundary-kind");
  }

 private:
  static constexpr std::size_t most_told = 20;

  void by_column(one_file& f, const std::vector<double>& column) {
    std::vector<double> values;
    for (const std::string& v : rule_->values) {
      const auto number = number_in(v);
      if (!number) throw error("--boundary-kind: \"" + v + "\" should be a number");
      values.push_back(*number);
    }
    f.content.kind.assign(f.rows, particle_kind::fluid);
    for (std::size_t i = 0; i < f.rows; ++i) {
      const auto at = std::ranges::find(values, column[i]);
      if ((i == 0 || column[i] != column[i - 1]) && there_.size() < most_told) there_.insert(number_text(column[i]));
      if (at == values.end()) continue;
      f.content.kind[i] = particle_kind::boundary;
      used_[static_cast<std::size_t>(at - values.begin())] = true;
    }
  }

  const std::optional<boundary_rule>& rule_;
  std::vector<bool> used_;
  std::set<std::string> there_;
};

}  // namespace

void choose_kinds(set_in_making& s) {
  const auto rule = boundary_rule::of(s.told.boundary_kind);
  rule_use use(rule);
  bool assumed = false, by_name = false;
  for (one_file& f : s.files) {
    std::vector<particle_kind>& kind = f.content.kind;
    if (f.by_path) {
      kind.assign(f.rows, *f.by_path);
    } else if (rule && rule->none()) {
      kind.assign(f.rows, particle_kind::fluid);
    } else if (rule) {
      use.apply(f);
    } else if (kind.empty()) {
      kind.assign(f.rows, particle_kind::fluid);
      assumed = true;
    }
    by_name = by_name || (f.content.kinds_by_name && !f.by_path);
    if (kind.size() != f.rows) throw error(f.name() + ": kinds and positions differ in number");
    f.content.others.clear();
  }
  use.check(s);
  std::size_t fluid = 0, boundary = 0;
  for (const one_file& f : s.files)
    for (const particle_kind k : f.content.kind) (k == particle_kind::fluid ? fluid : boundary)++;
  if (fluid == 0)
    throw error(s.named() +
                ": no particle is fluid; --boundary-kind none takes all as fluid, PATH:fluid those of a file");
  const bool by_option =
      rule.has_value() || std::ranges::any_of(s.files, [](const one_file& f) { return f.by_path.has_value(); });
  const origin how = by_option ? origin::given : assumed || by_name ? origin::assumed : origin::read;
  const char* const from = by_option ? "by option"
                           : by_name ? "by the names of the groups; --boundary-kind says otherwise"
                           : assumed ? "nothing says what is boundary; --boundary-kind does"
                                     : "the file";
  s.tell("fluid", std::to_string(fluid), how, from);
  s.tell("boundary", std::to_string(boundary), how, from);
}

}  // namespace pairsum::files
