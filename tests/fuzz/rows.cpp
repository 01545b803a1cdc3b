// Rows files: any file is read, or refused with one line; read at once or while it grows, it has the same rows.
#include "harness/rows/reader.hpp"
#include "on_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pairsum;
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
    rows.valid_paces();
    rows.finished_rounds();
    rows.unfinished_rounds();
  });
  return 0;
}
