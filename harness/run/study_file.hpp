#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "harness/rows/writer.hpp"
#include "harness/run/file_lock.hpp"
#include "harness/run/rows_so_far.hpp"
#include "harness/run/writable_file.hpp"

namespace pairsum::harness {

/// The rows file of a study while that is carried out: locked, resumed, appended to, and read as others append to it.
class study_file {
 public:
  /// Throws pairsum::error for a file that another study is writing, that cannot be written, or that another schema,
  /// machine or build wrote; with plan.builds > 1 for one of another schema or machine.
  study_file(const std::filesystem::path& path, const study_plan& plan, const environment_row& environment);

  const rows_so_far& so_far() const { return so_far_; }
  /// Takes in what others have appended. Like what follows, throws pairsum::error if the file is no longer in its
  /// place.
  void read_on();
  /// The same after one of them was killed: takes a cut last line away. Returns its number of bytes.
  std::size_t mend();

  /// Writes the environment's row if it is not there. Nothing is written before, so that bad input leaves no file.
  void open();
  /// Opens the file and writes a row; it is taken in with the next read_on().
  void write(const row& r);
  /// Writes void rows for this unfinished round, or for all of them.
  void void_rounds(const std::string& why, std::optional<int> only = {});

 private:
  void must_be_in_place() const { lock_.must_be_in_place(so_far_.bytes()); }

  std::filesystem::path path_;
  std::string study_;
  environment_row environment_;
  file_lock lock_;
  rows_so_far so_far_;
  std::unique_ptr<writable_file> written_;
  std::optional<row_writer> writer_;
};

}  // namespace pairsum::harness
