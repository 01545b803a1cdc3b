// HDF5 files of several programs, by the names of hdf5_dialects.cpp. They are read in a child process, since HDF5 may
// crash or hang on damaged files.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <pairsum/core/error.hpp>
#include <pairsum/core/names.hpp>
#include <pairsum/files/column_room.hpp>
#include <pairsum/files/formats.hpp>
#include <pairsum/files/hdf5_groups.hpp>
#include <pairsum/files/in_child.hpp>
#include <pairsum/files/shown.hpp>
#include <pairsum/files/words.hpp>

namespace pairsum::files {
namespace {

/// Reads what one file, or the files of one snapshot, hold.
class dialect_reader {
 public:
  dialect_reader(const hdf5_file& first, const hdf5_dialect& names, const hints& told)
      : first_(first), names_(names), told_(told) {}

  void header(const std::vector<particle_group>& groups);
  /// The content of groups of one name: one, or one of each part of a snapshot.
  file_content columns(std::span<const particle_group> groups) const;
  file_content content;
  std::optional<std::vector<double>> attribute(const std::string& group, std::string_view alternatives) const {
    return attribute_of(first_, group, alternatives);
  }

 private:
  void box(const std::string& group);
  static void quantity(std::span<const particle_group> groups, sources particle_group::*which, const char* what,
                       std::span<std::vector<double>* const> to);

  const hdf5_file& first_;
  const hdf5_dialect& names_;
  const hints& told_;
};

void dialect_reader::box(const std::string& group) {
  auto &low = content.box_low, &high = content.box_high;
  const auto lows = attribute(group, names_.low), highs = attribute(group, names_.high),
             limits = attribute(group, names_.limits), edges = attribute(group, names_.edges);
  if (lows && highs) {
    low = *lows;
    high = *highs;
  } else if (limits && limits->size() == 6) {
    for (std::size_t d = 0; d < 3; ++d) {
      low.push_back((*limits)[2 * d]);
      high.push_back((*limits)[2 * d + 1]);
    }
  } else if (edges && std::ranges::any_of(*edges, [](double e) { return e != 0; })) {
    high = edges->size() == 1 ? std::vector<double>(3, edges->front()) : *edges;
    low.assign(high.size(), 0.0);
  }
  if (low.size() != high.size())
    throw error(first_.path() + ": the box has " + std::to_string(low.size()) + " low and " +
                std::to_string(high.size()) + " high ends");
  const auto periodic = attribute(group, names_.axes);
  if (low.empty()) return;
  axes on = names_.periodic ? axes::all(3) : axes{};
  if (periodic)
    for (std::size_t d = 0; d < 3; ++d) on.on[d] = (*periodic)[std::min(d, periodic->size() - 1)] == 1;
  content.periodic = on;
  content.periodic_by_habit = !periodic;
}

void dialect_reader::header(const std::vector<particle_group>& groups) {
  const std::string& group = groups.front().path;
  const auto one = [&](std::string_view alternatives) -> std::optional<double> {
    const auto found = attribute(group, alternatives);
    return found ? std::optional(found->front()) : std::nullopt;
  };
  content.time = one(names_.time);
  content.rho0 = one(names_.rho0);
  content.B = one(names_.B);
  content.gravity = one(names_.gravity);
  content.dx = one(names_.dx);
  const std::size_t axes_of_file = groups.front().x.size();
  if (const auto dim = one(names_.dim)) {
    if (*dim != 1 && *dim != 2 && *dim != 3)
      throw error(first_.path() + ": Dimension is " + number_text(*dim) + ", should be 1, 2 or 3");
    content.dim = static_cast<int>(*dim);
  }
  box(group);
  const auto support = [&](double s, origin how, const std::string& from) {
    if (!(s > 0)) throw error(first_.path() + ": " + from + " is " + number_text(s) + ", should be positive");
    content.support = s;
    if (!told_.H && !told_.support) content.facts.push_back({"support", number_text(s) + " h", how, from});
  };
  content.H = one(names_.H);
  if (content.H) return;
  if (std::ranges::all_of(groups, [](const particle_group& g) { return g.h.empty(); })) return;
  const std::size_t at = names_.length_is.find('@');
  const std::string header(names_.length_is.substr(0, at)),
      word(at == names_.length_is.npos ? "" : names_.length_is.substr(at + 1));
  const auto is = first_.has(header) ? first_.text(header, word) : std::nullopt;
  if (is && *is != "h" && *is != "support")
    throw error(first_.path() + ": " + word + " is " + shown(*is) + ", should be \"h\" or \"support\"");
  if (is == "support") return support(1, origin::read, word + " of the header: h is the support radius");
  if (const auto gamma = one(names_.gamma)) return support(*gamma, origin::read, "Kernel gamma");
  for (const std::string_view f : split(names_.function, '|')) {
    const std::string object(f.substr(0, f.find('@'))), name(f.substr(f.find('@') + 1));
    const auto function = first_.has(object) ? first_.text(object, name) : std::nullopt;
    const double gamma = function ? gamma_of(*function, content.dim.value_or(static_cast<int>(axes_of_file))) : 0;
    if (gamma > 0) return support(gamma, origin::derived, "the smoothing kernel, " + *function);
  }
  if (is) return support(2, origin::assumed, word + " is h; --support says how much larger the support radius is");
  if (names_.support > 0)
    support(names_.support, origin::assumed, "as " + std::string(names_.name) + " writes it; --support says otherwise");
}

/// Reads a quantity of groups of one name, one after the other.
void dialect_reader::quantity(std::span<const particle_group> groups, sources particle_group::*which, const char* what,
                              std::span<std::vector<double>* const> to) {
  const particle_group& first = groups.front();
  const std::size_t columns = (first.*which).size();
  std::size_t rows = 0, begin = 0;
  for (const particle_group& g : groups) {
    rows += g.rows;
    if (!std::ranges::equal(g.*which, first.*which, {}, &source::axis, &source::axis))
      throw error(g.file->path() + ": " + g.path + " has " + std::to_string((g.*which).size()) + " columns of " + what +
                  ", but " + std::to_string(columns) + " in " + first.file->path());
  }
  for (const source& s : first.*which) resize_column(*to[s.axis], rows);
  for (const particle_group& g : groups) {
    const sources& all = g.*which;
    for (std::size_t k = 0; k < columns;) {
      std::vector<std::size_t> of_dataset;
      std::vector<double*> places;
      const std::string& dataset = all[k].dataset;
      for (; k < columns && all[k].dataset == dataset; ++k) {
        of_dataset.push_back(all[k].column);
        places.push_back(to[all[k].axis]->data() + begin);
      }
      g.file->read(dataset, of_dataset, places);
    }
    begin += g.rows;
  }
}

file_content dialect_reader::columns(std::span<const particle_group> groups) const {
  file_content c = content;
  const particle_group& first = groups.front();
  const auto three = [](std::array<std::vector<double>, 3>& a) { return std::array{&a[0], &a[1], &a[2]}; };
  quantity(groups, &particle_group::x, "positions", three(c.x));
  quantity(groups, &particle_group::v, "velocities", three(c.v));
  const auto one = [&](sources particle_group::*which, const char* what, std::vector<double>& to) {
    quantity(groups, which, what, std::array{&to});
  };
  one(&particle_group::rho, "density", c.rho);
  one(&particle_group::m, "mass", c.m);
  one(&particle_group::h, "h", c.h);
  if (!first.other.empty())
    one(&particle_group::other, "kind", c.others[boundary_rule::of(told_.boundary_kind)->column]);
  if (const auto masses = attribute(first.path, names_.masses)) {
    const auto k = static_cast<std::size_t>(first.number());
    if (k < masses->size() && (*masses)[k] > 0) c.m_of_all = (*masses)[k];
  }
  std::vector<double> kinds;
  one(&particle_group::kind, "kind", kinds);
  const bool by_rule = !told_.boundary_kind.empty();
  const bool by_name = names_.meant == groups_meant::all,
             by_type = names_.meant == groups_meant::first && first.number() == 0;
  if (by_rule || by_name || by_type || !kinds.empty())
    c.kind.assign(c.x[first.x.front().axis].size(), first.boundary ? particle_kind::boundary : particle_kind::fluid);
  c.kinds_by_name = by_name && !by_rule && kinds.empty();
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] != 0 && kinds[i] != 1)
      throw error(first_.path() + ": the kind of particle " + std::to_string(i + 1) + " is " + number_text(kinds[i]) +
                  ", should be 0 (fluid) or 1 (boundary)");
    c.kind[i] = static_cast<particle_kind>(kinds[i]);
  }
  return c;
}

/// The dialect of a file. Errors: none.
const hdf5_dialect& dialect_of(const hdf5_file& file) {
  const auto marked = [&](const hdf5_dialect& d, const std::string& group) {
    return d.marks.empty() || std::ranges::any_of(split(d.marks, '|'), [&](std::string_view mark) {
             const std::size_t at = mark.find('@');
             if (at == mark.npos) return file.has(std::string(mark));
             const std::string object = at == 0 ? group : std::string(mark.substr(0, at));
             return file.has(object) && file.numbers(object, std::string(mark.substr(at + 1))).has_value();
           });
  };
  for (const hdf5_dialect& d : hdf5_dialects())
    if (const auto groups = matching(file, d.groups); !groups.empty() && marked(d, groups.front().path)) return d;
  throw error(file.path() +
              " is HDF5, but has none of the groups PartType0 (GADGET, SWIFT), particles/NAME/arrays (PySPH), Step#0 " +
              "(H5Part, SPH-EXA) and VTKHDF; `pairsum convert` reads more");
}

/// The paths of all files of a snapshot whose file k is NAME.k.ENDING.
std::vector<std::string> siblings(const std::string& path, double count) {
  const std::size_t ending = path.rfind('.'),
                    digits = ending == path.npos || ending == 0 ? path.npos : path.rfind('.', ending - 1);
  const std::string of = path + " is one of " + number_text(count) + " files of a snapshot";
  if (digits == path.npos || !number_in(path.substr(digits + 1, ending - digits - 1)) || !(count < 100'000))
    throw error(of + ", but its name has no number, as in NAME.0.hdf5");
  std::vector<std::string> all;
  for (int k = 0; k < count; ++k) {
    all.push_back(path.substr(0, digits + 1) + std::to_string(k) + path.substr(ending));
    if (access(all.back().c_str(), R_OK) != 0) throw error(of + ", but " + all.back() + " cannot be read");
  }
  return all;
}

file_content read_here(const std::string& path, const hints& told) {
  std::vector<std::unique_ptr<hdf5_file>> files;
  files.push_back(std::make_unique<hdf5_file>(path));
  const hdf5_dialect& names = dialect_of(*files[0]);
  dialect_reader reader(*files[0], names, told);
  reader.content.format = "hdf5";
  reader.content.dialect = names.name;
  const auto parts = reader.attribute("", names.files);
  std::vector<particle_group> groups;
  if (parts && parts->front() > 1) {
    for (const std::string& part : siblings(path, parts->front())) {
      files.push_back(std::make_unique<hdf5_file>(part));
      for (particle_group& g : groups_of(*files.back(), names, told, reader.content)) groups.push_back(std::move(g));
      reader.content.parts.push_back(part);
    }
    reader.content.facts.push_back({"files of the snapshot", number_text(parts->front()), origin::read, "the header"});
  } else {
    groups = groups_of(*files[0], names, told, reader.content);
  }
  if (groups.empty()) throw error(path + " has no particles");
  reader.header(groups);
  std::ranges::stable_sort(groups, {}, &particle_group::label);
  std::vector<file_content> all;
  for (auto begin = groups.begin(); begin != groups.end();) {
    const auto end =
        std::find_if(begin, groups.end(), [&](const particle_group& g) { return g.label != begin->label; });
    all.push_back(reader.columns({begin, end}));
    if (begin != groups.begin() || end != groups.end()) all.back().label = begin->label;
    reader.content.facts.clear();
    reader.content.parts.clear();
    begin = end;
  }
  file_content first = std::move(all.front());
  all.erase(all.begin());
  first.more = std::move(all);
  return first;
}

bool recognises(std::span<const std::byte> head, std::string_view) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  for (std::size_t at = 0; at + signature.size() <= head.size(); at = at == 0 ? 512 : 2 * at)
    if (std::memcmp(head.data() + at, signature.data(), signature.size()) == 0) return true;
  return false;
}

file_content read(const std::string& path, const hints& told) {
  struct stat about {};
  const auto bytes = stat(path.c_str(), &about) == 0 ? static_cast<std::uint64_t>(about.st_size) : 0;
  return in_child(path, seconds_for(bytes), [&] {
    setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // some file systems have no locks, and this child writes nothing
    return read_here(path, told);
  });
}

}  // namespace

namespace formats_of {
file_format hdf5();
file_format hdf5() { return {"hdf5", "HDF5 of GADGET, SWIFT, PySPH, H5Part, SPH-EXA and VTKHDF", recognises, read}; }
}  // namespace formats_of
}  // namespace pairsum::files
