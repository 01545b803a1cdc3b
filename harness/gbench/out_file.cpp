#include "harness/gbench/out_file.hpp"

#include <benchmark/benchmark.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <pairsum/core/error.hpp>

#pragma GCC diagnostic ignored "-Wdeprecated-declarations"  // CSVReporter, which --benchmark_out_format=csv names

namespace pairsum::harness {
namespace {

/// Notes the first reason for which the stream of a reporter did not take what was written.
template <class Reporter>
class watched final : public Reporter {
 public:
  template <class... Options>
  explicit watched(std::string& lost, Options... options) : Reporter(options...), lost_(lost) {}

  bool ReportContext(const benchmark::BenchmarkReporter::Context& context) override {
    return watch([&] { return Reporter::ReportContext(context); });
  }
  void ReportRuns(const std::vector<benchmark::BenchmarkReporter::Run>& runs) override {
    watch([&] { return Reporter::ReportRuns(runs), true; });
  }
  void Finalize() override {
    watch([&] { return Reporter::Finalize(), true; });
  }

 private:
  template <class Write>
  bool watch(Write&& write) {
    errno = 0;
    const bool done = write();
    if (!this->GetOutputStream().flush() && lost_.empty())
      lost_ = errno != 0 ? std::strerror(errno) : "it cannot be written";
    return done;
  }

  std::string& lost_;
};

}  // namespace

out_file::out_file(std::string name, const std::string& format) : name_(std::move(name)) {
  using namespace benchmark;
  if (name_.empty()) return;
  errno = 0;
  if (!std::ofstream(name_, std::ios::app)) throw error("cannot write " + name_ + ": " + std::strerror(errno));
  if (format == "console")
    reporter_ = std::make_unique<watched<ConsoleReporter>>(lost_, ConsoleReporter::OO_None);
  else if (format == "csv")
    reporter_ = std::make_unique<watched<CSVReporter>>(lost_);
  else
    reporter_ = std::make_unique<watched<JSONReporter>>(lost_);
}

out_file::~out_file() = default;

void out_file::check() const {
  if (!lost_.empty()) throw error("cannot write " + name_ + ": " + lost_);
}

}  // namespace pairsum::harness
