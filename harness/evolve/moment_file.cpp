#include "harness/evolve/moment_file.hpp"

#include <pairsum/core/error.hpp>
#if PAIRSUM_HAS_FILES
#include <pairsum/files/read_particles.hpp>
#include <pairsum/files/write_hdf.hpp>
#endif

namespace pairsum::harness {
#if PAIRSUM_HAS_FILES

std::string why_no_moment_files() { return ""; }

void write_moment(const std::filesystem::path& file, const moment& m, const initial_condition& domain,
                  const std::string& settings) {
  initial_condition now = domain;
  now.particles = m.particles;
  files::snapshot about;
  about.time = m.t;
  about.step = m.step;
  about.ids = m.ids;
  about.lost = m.lost;
  about.next_dt = m.next_dt;
  about.settings = settings;
  files::write_hdf(file.string(), now, about);
}

saved_moment read_moment(const std::filesystem::path& file) {
  files::read_set set = files::read_particles({file.string()});
  files::snapshot about = files::read_about(file.string());
  if (about.ids.size() != set.initial.particles.size())
    throw error(file.string() + ": has other numbers of ids and particles");
  return {{std::move(set.initial.particles), std::move(about.ids), about.time, about.step, about.next_dt, about.lost},
          std::move(about.settings),
          std::move(set.hash)};
}

void write_series(const std::filesystem::path& file, const std::vector<std::filesystem::path>& moments) {
  std::vector<files::snapshot_file> series;
  for (const auto& m : moments) {
    const files::snapshot about = files::read_about(m.string());
    series.push_back({m.string(), about.time, about.ids.size()});
  }
  files::write_xmf(file.string(), series);
}

#else

std::string why_no_moment_files() { return "this build writes no particle files: it was made without PAIRSUM_FILES"; }
void write_moment(const std::filesystem::path&, const moment&, const initial_condition&, const std::string&) {
  throw error(why_no_moment_files());
}
saved_moment read_moment(const std::filesystem::path&) { throw error(why_no_moment_files()); }
void write_series(const std::filesystem::path&, const std::vector<std::filesystem::path>&) {
  throw error(why_no_moment_files());
}

#endif
}  // namespace pairsum::harness
