// Rows files: any file is read, or refused with one line; read at once or while it grows, it has the same rows; a row
// that was read is the same once written.
#include <nlohmann/json.hpp>
#include <string_view>

#include "harness/rows/reader.hpp"
#include "harness/rows/row.hpp"
#include "on_file.hpp"

namespace {

using namespace pairsum;

void write_again(const auto& rows) {
  for (const auto& r : rows)
    if (std::get<std::decay_t<decltype(r)>>(harness::parse_row(nlohmann::json::parse(harness::format_row(r)))) != r)
      fuzz::fault("a row is another once written");
}

/// The same rows, where the file has at first its beginning alone.
void grow(std::string_view text, const harness::rows_file& whole) {
  const std::size_t end = text.find('\n', text.size() / 2);
  if (end == text.npos) return;
  const int file = memfd_create("grown", MFD_CLOEXEC);
  const auto add = [&](std::string_view more) {
    if (write(file, more.data(), more.size()) != static_cast<ssize_t>(more.size())) std::abort();
  };
  add(text.substr(0, end + 1));
  harness::rows_reader reader(fmt::format("/proc/self/fd/{}", file));
  reader.read_on(harness::cut_line::drop);
  const bool cut = reader.rows().last_line_cut;  // the text goes on behind a line that is no row
  add(text.substr(end + 1));
  if (!cut) reader.read_on(harness::cut_line::drop);
  close(file);
  if (!cut && (reader.rows().samples != whole.samples || reader.rows().size() != whole.size()))
    fuzz::fault("a file that grew has other rows");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::size_t whole = 0;
  const auto all = [&](const std::string& path) { whole = harness::read_rows(path, harness::cut_line::drop).size(); };
  if (!fuzz::on_file(data, size, all)) return 0;
  fuzz::on_file(data, size, [](const std::string& path) { harness::read_rows(path); });
  fuzz::on_file(data, size, [&](const std::string& path) {
    const harness::rows_file rows = harness::read_rows(path, harness::cut_line::drop);
    harness::rows_reader again(path);
    again.drop_cut_line();
    if (again.rows().size() != whole) fuzz::fault("without its cut line the file has other rows");
    if (rows.valid_samples().size() > rows.samples.size()) fuzz::fault("more samples are valid than there are");
    if (!rows.former_schema) {
      write_again(rows.samples);
      write_again(rows.environments);
      write_again(rows.backends);
      write_again(rows.voids);
      write_again(rows.peaks);
      write_again(rows.paces);
      write_again(rows.rounds);
      write_again(rows.ends);
    }
    try {
      grow({reinterpret_cast<const char*>(data), size}, rows);
    } catch (const error& e) {
      fuzz::fault(fmt::format("a file that grew is refused: {}", e.what()));
    }
    rows.valid_paces();
    rows.finished_rounds();
    rows.unfinished_rounds();
  });
  return 0;
}
