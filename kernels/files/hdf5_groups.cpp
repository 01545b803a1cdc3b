// Which groups of an HDF5 file hold particles, and where their columns are.
#include <algorithm>
#include <initializer_list>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/hdf5_groups.hpp>
#include <pairsum/files/words.hpp>

namespace pairsum::files {
namespace {

/// A name of a dataset below a group as the file spells it; empty if there is none.
std::string spelt(const hdf5_file& file, const std::string& group, std::string_view name) {
  std::string at = group;
  for (const std::string_view part : split(name, '/')) {
    const std::vector<std::string> names = file.names(at);
    auto found = std::ranges::find(names, part);
    if (found == names.end())
      found = std::ranges::find_if(names, [&](const std::string& n) { return same_word(n, part); });
    if (found == names.end()) return {};
    at += (at.empty() ? "" : "/") + *found;
  }
  return at;
}

sources datasets(const hdf5_file& file, const std::string& group, std::string_view alternatives) {
  for (const std::string_view one : split(alternatives, '|')) {
    sources found;
    const auto names = split(one, ',');
    for (std::size_t axis = 0; axis < names.size(); ++axis) {
      const std::string dataset = spelt(file, group, names[axis]);
      if (dataset.empty()) continue;
      const std::size_t columns = names.size() > 1 ? 1 : file.shape_of(dataset).columns;
      for (std::size_t c = 0; c < columns; ++c) found.push_back({dataset, c, names.size() > 1 ? axis : c});
    }
    if (!found.empty()) return found;
  }
  return {};
}

/// As an option says, DATASET or DATASET:COLUMN, else as the dialect does.
sources told_or(const hints& options, const particle_group& g, std::initializer_list<const char*> quantities,
                std::string_view alternatives) {
  sources found;
  for (std::size_t axis = 0; axis < quantities.size(); ++axis) {
    const std::string quantity = quantities.begin()[axis];
    const auto told = options.columns.find(quantity);
    if (told == options.columns.end()) continue;
    const std::size_t colon = told->second.rfind(':');
    const std::string dataset = spelt(*g.file, g.path, told->second.substr(0, colon));
    const auto column = colon == told->second.npos ? 0 : number_in(told->second.substr(colon + 1)).value_or(-1);
    if (dataset.empty())
      throw error(g.file->path() + ": " + g.path + " has no " + told->second + " for " + quantity + "; it has " +
                  join(g.file->names(g.path)));
    const std::size_t columns = g.file->shape_of(dataset).columns;
    if (!(column >= 0 && column < static_cast<double>(columns)))
      throw error(g.file->path() + ": " + dataset + " has " + std::to_string(columns) + " columns, no " + told->second);
    found.push_back({dataset, static_cast<std::size_t>(column), axis});
  }
  return found.empty() ? datasets(*g.file, g.path, alternatives) : found;
}

void locate(particle_group& g, const hdf5_dialect& names, const hints& told) {
  g.x = told_or(told, g, {"x", "y", "z"}, names.x);
  if (g.x.empty()) return;
  g.rows = g.file->shape_of(g.x[0].dataset).rows;
  g.v = told_or(told, g, {"vx", "vy", "vz"}, names.v);
  g.rho = told_or(told, g, {"rho"}, names.rho);
  g.m = told_or(told, g, {"m"}, names.m);
  g.h = told_or(told, g, {"h"}, names.h);
  g.kind = told_or(told, g, {"kind"}, names.kind);
  if (const auto rule = boundary_rule::of(told.boundary_kind)) {
    g.kind.clear();
    if (!rule->names_groups() && !rule->none()) g.other = datasets(*g.file, g.path, rule->column);
  }
  for (const sources* const all : {&g.x, &g.v, &g.rho, &g.m, &g.h, &g.kind, &g.other})
    for (const source& s : *all) {
      const std::size_t rows = g.file->shape_of(s.dataset).rows;
      if (rows != g.rows)
        throw error(g.file->path() + ": " + s.dataset + " has " + std::to_string(rows) + " rows, but " +
                    g.x[0].dataset + " has " + std::to_string(g.rows));
    }
  for (const sources* const one : {&g.rho, &g.m, &g.h, &g.kind, &g.other})
    if (one->size() > 1)
      throw error(g.file->path() + ": " + one->front().dataset + " has several columns, should have one");
}

}  // namespace

std::optional<std::vector<double>> attribute_of(const hdf5_file& file, const std::string& group,
                                                std::string_view alternatives) {
  for (const std::string_view one : split(alternatives, '|')) {
    const std::size_t at = one.find('@');
    const std::string object = at == 0 ? group : std::string(one.substr(0, at)), name(one.substr(at + 1));
    if (!object.empty() && !file.has(object)) continue;
    if (auto numbers = file.numbers(object, name)) return numbers;
    if (const auto text = file.text(object, name))
      if (const auto number = number_in(*text)) return std::vector<double>{*number};
  }
  return {};
}

std::vector<particle_group> matching(const hdf5_file& file, std::string_view pattern) {
  std::vector<particle_group> found;
  const auto named = [&](const std::string& path, const std::string& label) {
    particle_group g;
    g.file = &file;
    g.path = path;
    g.label = label;
    return g;
  };
  const std::size_t star = pattern.find('*');
  if (star == pattern.npos) {
    if (file.has(std::string(pattern))) found.push_back(named(std::string(pattern), std::string(pattern)));
    return found;
  }
  const std::size_t slash = pattern.rfind('/', star);
  const std::string parent(slash == pattern.npos ? "" : pattern.substr(0, slash));
  const std::string_view begins =
      pattern.substr(slash == pattern.npos ? 0 : slash + 1, star - (slash == pattern.npos ? 0 : slash + 1));
  const std::string below(pattern.substr(star + 1));
  for (const std::string& name : file.names(parent)) {
    const std::string path = (parent.empty() ? "" : parent + "/") + name + below;
    if (name.starts_with(begins) && file.has(path)) {
      found.push_back(named(path, name));
    }
  }
  return found;
}

std::vector<particle_group> groups_of(const hdf5_file& file, const hdf5_dialect& names, const hints& told,
                                      file_content& content) {
  std::vector<particle_group> all = matching(file, names.groups), meant;
  if (names.meant == groups_meant::last) {
    std::ranges::sort(all, {}, &particle_group::number);
    if (told.step) std::erase_if(all, [&](const particle_group& g) { return g.number() != *told.step; });
    if (all.empty()) throw error(file.path() + " has no step " + std::to_string(*told.step));
    all.erase(all.begin(), all.end() - 1);
  }
  for (particle_group& g : all) {
    locate(g, names, told);
    if (std::ranges::find(content.groups, g.label) == content.groups.end()) content.groups.push_back(g.label);
  }
  std::erase_if(all, [](const particle_group& g) { return g.rows == 0; });
  const auto rule = boundary_rule::of(told.boundary_kind);
  const auto counts = attribute_of(file, "", names.counts);
  for (particle_group& g : all) {
    const auto k = static_cast<std::size_t>(g.number());
    if (counts && g.number() >= 0 && k < counts->size() && (*counts)[k] != static_cast<double>(g.rows))
      throw error(file.path() + ": " + g.x[0].dataset + " has " + std::to_string(g.rows) +
                  " rows, but the header counts " + number_text((*counts)[k]));
    g.boundary = rule && rule->names_groups() && rule->takes(g.label);
    if (names.meant != groups_meant::all || rule || !g.kind.empty()) continue;
    const kind_word kind = kind_named(g.label);
    if (kind == kind_word::body)
      throw error(file.path() + ": the group " + g.label +
                  " is a body that moves, by its name, which pairsum does not sum; --boundary-kind name=" + g.label +
                  " takes it for boundary, none all particles for fluid");
    g.boundary = kind == kind_word::boundary;
  }
  if (names.meant != groups_meant::first || (rule && rule->none())) return all;
  const bool fluid = std::ranges::any_of(all, [](const particle_group& g) { return g.number() == 0; });
  const auto others = std::ranges::count_if(all, [](const particle_group& g) { return !g.boundary; });
  std::string left_out;
  for (particle_group& g : all) {
    if (g.boundary || g.number() == 0 || (!fluid && others == 1)) {
      meant.push_back(g);
    } else {
      left_out += (left_out.empty() ? "" : ", ") + std::to_string(g.rows) + " of " + g.label;
    }
  }
  if (meant.empty() && !all.empty())
    throw error(file.path() + " has no fluid, which is PartType0, but " + left_out +
                "; --boundary-kind PartType=N takes one as boundary");
  if (!left_out.empty())
    content.facts.push_back({"left out", left_out, origin::assumed,
                             "PartType0 is the fluid; --boundary-kind PartType=N takes another as boundary"});
  return meant;
}

}  // namespace pairsum::files
