#include <pairsum/files/read_particles.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/formats.hpp>
#include <pairsum/files/set_in_making.hpp>

namespace pairsum::files {
namespace {

/// Takes ":fluid" or ":boundary" off a path, unless a file is named so.
std::optional<particle_kind> kind_of_path(std::string& path) {
  constexpr std::array<std::pair<std::string_view, particle_kind>, 2> endings{
      {{":fluid", particle_kind::fluid}, {":boundary", particle_kind::boundary}}};
  for (const auto& [ending, kind] : endings)
    if (path.ends_with(ending) && access(path.c_str(), F_OK) != 0) {
      path.resize(path.size() - ending.size());
      return kind;
    }
  return {};
}

/// The same for all paths that lead to a file.
std::string name_of(const std::string& path) {
  std::error_code problem;
  const std::filesystem::path name = std::filesystem::canonical(path, problem);
  return problem ? path : name.string();
}

/// Checks that the columns of a file, or of a group in it, belong together.
one_file checked(const std::string& path, std::optional<particle_kind> by_path, file_content content) {
  one_file f{path, by_path, std::move(content), 0};
  file_content& c = f.content;
  std::vector<std::vector<double>*> columns{&c.x[0], &c.x[1], &c.x[2], &c.v[0], &c.v[1], &c.v[2], &c.rho, &c.m, &c.h};
  for (auto& [name, column] : c.others) columns.push_back(&column);
  f.rows = std::max({c.x[0].size(), c.x[1].size(), c.x[2].size()});
  if (f.rows == 0) throw error(path + " has no particles");
  for (const auto* const column : columns)
    if (!column->empty() && column->size() != f.rows)
      throw error(f.name() + ": a column has " + std::to_string(column->size()) + " rows, positions have " +
                  std::to_string(f.rows));
  return f;
}

}  // namespace

read_set read_particles(const std::vector<std::string>& paths, const hints& told) {
  if (paths.empty()) throw error("no file of particles is named");
  set_in_making s{told};
  std::size_t total = 0;
  std::set<std::string> given;
  std::map<std::string, std::size_t> part_of;  // the parts of snapshots, and by which of the files they were read
  for (std::string path : paths) {
    const auto kind = kind_of_path(path);
    const std::string name = name_of(path);
    if (!given.insert(name).second) throw error(path + " is given twice; each file of a set is read once");
    if (const auto whole = part_of.find(name); whole != part_of.end()) {
      const std::string& other = s.files[whole->second].path;
      if (s.files[whole->second].by_path != kind)
        throw error(path + " and " + other + " are parts of one snapshot, and should both be fluid or both boundary");
      s.tell("file", path, origin::read, "a part of the snapshot that " + other + " belongs to, read with it");
      continue;
    }
    file_content content = read_file(path, told);
    for (const std::string& part : content.parts) part_of[name_of(part)] = s.files.size();
    std::vector<fact> facts = std::move(content.facts);
    const std::string format = content.format + (content.dialect.empty() ? "" : ", " + content.dialect);
    std::vector<file_content> more = std::move(content.more);
    s.files.push_back(checked(path, kind, std::move(content)));
    std::size_t rows = s.files.back().rows;
    for (file_content& group : more) {
      s.files.push_back(checked(path, kind, std::move(group)));
      rows += s.files.back().rows;
    }
    ++s.paths;
    total += rows;
    s.tell("file", path, origin::read, format + ", " + std::to_string(rows) + " particles");
    std::ranges::move(facts, std::back_inserter(s.made.facts));
  }
  if (total > most_particles)
    throw error(s.named() + " hold " + std::to_string(total) + " particles, more than the " +
                std::to_string(most_particles) + " that pairsum counts");
  choose_kinds(s);
  check_numbers(s);
  choose_axes(s);
  complete_columns(s);
  choose_H(s);
  gather(s);
  choose_domain(s);
  if (const auto time = s.first([](const file_content& c) { return c.time; })) s.made.time = *time;
  s.made.hash = hash_of(s.made.initial);
  return std::move(s.made);
}

std::string hash_of(const initial_condition& c) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto word = [&](std::uint64_t bits) {  // FNV-1a of words, which moves no bit down: so they are shifted
    hash = (hash ^ bits) * 0x100000001b3u;
    hash ^= hash >> 32;
  };
  const auto column = [&](const std::vector<double>& all) {
    word(all.size());
    for (const double a : all) word(std::bit_cast<std::uint64_t>(a));
  };
  const particle_table& p = c.particles;
  for (const auto& all : {std::cref(p.x), std::cref(p.v)})
    for (const auto& one : all.get()) column(one);
  column(p.rho);
  column(p.m);
  for (const particle_kind k : p.kind) word(static_cast<std::uint64_t>(k));
  column(c.omega_low);
  column(c.omega_high);
  column({c.H, c.eos.rho0, c.eos.B, c.gravity});
  word(c.periodic.on[0] | c.periodic.on[1] << 1 | c.periodic.on[2] << 2);
  std::string text;
  for (int digit = 15; digit >= 0; --digit) text += "0123456789abcdef"[hash >> (4 * digit) & 15];
  return text;
}

}  // namespace pairsum::files
