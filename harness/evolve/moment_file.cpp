#include "harness/evolve/moment_file.hpp"

#include <algorithm>

#include <pairsum/core/error.hpp>
#if PAIRSUM_HAS_FILES
#include <pairsum/files/read_particles.hpp>
#include <pairsum/files/write_hdf.hpp>
#endif

namespace pairsum::harness {
#if PAIRSUM_HAS_FILES

std::string why_no_moment_files() { return ""; }

namespace {

files::origin origin_of(const std::string& word) {
  return static_cast<files::origin>(std::ranges::find(files::origin_words, word) - files::origin_words.begin());
}

}  // namespace

void write_moment(const std::filesystem::path& file, const moment& m, const particles_of_request& start,
                  const std::string& settings) {
  initial_condition now = start.initial;
  now.particles = m.particles;
  files::snapshot about;
  about.time = m.t;
  about.step = m.step;
  about.dx = start.dx;
  for (const auto& [what, value, how, from] : start.facts) about.facts.push_back({what, value, origin_of(how), from});
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

void write_series(const std::filesystem::path& file, const std::vector<moment_in_series>& moments) {
  std::vector<files::snapshot_file> series;
  for (const moment_in_series& m : moments) series.push_back({m.file.string(), m.t, m.particles});
  files::write_xmf(file.string(), series);
}

moment_in_series series_entry(const std::filesystem::path& file) {
  const files::snapshot about = files::read_about(file.string());
  return {file, about.time, about.ids.size()};
}

#else

std::string why_no_moment_files() { return "this build writes no particle files: it was made without PAIRSUM_FILES"; }
void write_moment(const std::filesystem::path&, const moment&, const particles_of_request&, const std::string&) {
  throw error(why_no_moment_files());
}
saved_moment read_moment(const std::filesystem::path&) { throw error(why_no_moment_files()); }
void write_series(const std::filesystem::path&, const std::vector<moment_in_series>&) {
  throw error(why_no_moment_files());
}
moment_in_series series_entry(const std::filesystem::path&) { throw error(why_no_moment_files()); }

#endif
}  // namespace pairsum::harness
