#include "harness/rows/writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include <pairsum/core/error.hpp>

namespace pairsum::harness {
namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& why) {
  throw error("cannot write rows to " + path.string() + ": " + why);
}

void must_name_a_file(const std::filesystem::path& path) {
  if (path.filename().empty()) cannot_write(path, "the path should name a file");
}

known_names names_in(const std::filesystem::path& path) {
  must_name_a_file(path);
  rows_reader reader(path);
  if (reader.has_rows()) reader.read_on();
  return reader.known();
}

/// Makes the directory entry of a new file durable; a file system that cannot is no error.
void sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

row_writer::row_writer(const std::filesystem::path& path) : row_writer(path, names_in(path)) {}

row_writer::row_writer(std::filesystem::path path, known_names known)
    : path_(std::move(path)), known_(std::move(known)) {
  must_name_a_file(path_);
  std::filesystem::path folder = path_.parent_path();
  if (folder.empty()) folder = ".";
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) cannot_write(path_, "folder " + folder.string() + ": " + code.message());
  file_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) cannot_write(path_, std::strerror(errno));
  sync_folder(folder);
}

row_writer::~row_writer() {
  if (file_ >= 0) ::close(file_);
}

template <class Row>
void row_writer::must_be_known(const Row& r) const {
  if constexpr (requires { r.environment; } && !std::is_same_v<Row, environment_row>)
    if (!knows(r.environment)) cannot_write(path_, "no environment row before the row is \"" + r.environment + "\"");
  if constexpr (std::is_same_v<Row, sample>) {
    if (!knows(r.environment, r.point.backend))
      cannot_write(path_, "no backend row before the row is \"" + r.point.backend + "\"");
    if (!r.point.particles.empty() && !knows_particles(r.point.particles))
      cannot_write(path_, "no particles row before the row is \"" + r.point.particles + "\"");
  }
}

void row_writer::write(const row& value) {
  const std::string text = format_row(value);
  try {
    parse_row(nlohmann::json::parse(text));
  } catch (const error& e) {
    cannot_write(path_, std::string("the row is wrong: ") + e.what());
  }
  std::visit([this](const auto& v) { must_be_known(v); }, value);

  const std::string line = text + "\n";
  struct stat before {};
  if (::fstat(file_, &before) != 0) cannot_write(path_, std::strerror(errno));
  ssize_t written = -1;
  do {
    written = ::write(file_, line.data(), line.size());
  } while (written < 0 && errno == EINTR);
  if (written < 0) cannot_write(path_, std::strerror(errno));
  if (static_cast<std::size_t>(written) < line.size()) {
    const bool undone = ::ftruncate(file_, before.st_size) == 0;
    cannot_write(path_,
                 undone ? "no space for the row, which was taken back" : "no space for the row, its last line is cut");
  }
  if (::fsync(file_) != 0) cannot_write(path_, std::strerror(errno));
  if (const auto* e = std::get_if<environment_row>(&value)) known_.environments.insert(e->environment);
  if (const auto* b = std::get_if<backend_row>(&value)) known_.backends.emplace(b->environment, b->name);
  if (const auto* p = std::get_if<particles_row>(&value)) known_.particles.insert(p->particles);
}

}  // namespace pairsum::harness
