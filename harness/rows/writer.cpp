#include "harness/rows/writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include <pairsum/core/error.hpp>
#include "harness/rows/reader.hpp"

namespace pairsum::harness {
namespace {

bool has_rows(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return false;
  return !std::filesystem::is_regular_file(path, code) || std::filesystem::file_size(path, code) > 0;
}

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& why) {
  throw error("cannot write rows to " + path.string() + ": " + why);
}

/// Makes the directory entry of a new file durable; a file system that cannot is no error.
void sync_folder(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

}  // namespace

row_writer::row_writer(std::filesystem::path path) : path_(std::move(path)) {
  if (path_.filename().empty()) cannot_write(path_, "the path should name a file");
  if (has_rows(path_))
    for (const environment_row& e : read_rows(path_).environments) environments_.insert(e.environment);
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

void row_writer::write(const row& value) {
  const std::string text = format_row(value);
  try {
    parse_row(nlohmann::json::parse(text));
  } catch (const error& e) {
    cannot_write(path_, std::string("the row is wrong: ") + e.what());
  }
  const std::string* const named = std::visit(
      [](const auto& v) -> const std::string* {
        if constexpr (requires { v.environment; })
          return &v.environment;
        else
          return nullptr;
      },
      value);
  if (named != nullptr && !std::holds_alternative<environment_row>(value) && environments_.count(*named) == 0)
    cannot_write(path_, "no environment row before the row is \"" + *named + "\"");

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
  if (const auto* e = std::get_if<environment_row>(&value)) environments_.insert(e->environment);
}

std::size_t drop_cut_line(const std::filesystem::path& path) {
  if (!has_rows(path) || !read_rows(path, cut_line::drop).last_line_cut) return 0;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  // The cut line may end in a newline of its own, as part of a cut text.
  const std::size_t before = text.size() < 2 ? text.npos : text.rfind('\n', text.size() - 2);
  const std::size_t keep = before == text.npos ? 0 : before + 1;
  std::error_code code;
  std::filesystem::resize_file(path, keep, code);
  if (code) cannot_write(path, code.message());
  return text.size() - keep;
}

}  // namespace pairsum::harness
