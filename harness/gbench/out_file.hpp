#pragma once
#include <memory>
#include <string>

namespace benchmark {
class BenchmarkReporter;
}

namespace pairsum::harness {

/// The file of --benchmark_out, of which Google Benchmark does not say that it could not be written.
class out_file {
 public:
  /// Throws pairsum::error for a file that cannot be opened. `format`: json, console or csv.
  out_file(std::string name, const std::string& format);
  ~out_file();

  /// What is to write the file; none without a name.
  benchmark::BenchmarkReporter* reporter() { return reporter_.get(); }

  /// Throws pairsum::error if a part of it was lost.
  void check() const;

 private:
  std::string name_, lost_;
  std::unique_ptr<benchmark::BenchmarkReporter> reporter_;
};

}  // namespace pairsum::harness
