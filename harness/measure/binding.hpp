#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pairsum::harness {

/// The location of a processing unit (hardware thread), as numbers that only mean "the same" and "before".
struct unit_place {
  int unit;  ///< the operating system's number
  int core, node, package;
};

/// The units in the order threads take them: first one of every core, then the second of every core, and so on; among
/// equals, cores alternate over packages, then over the NUMA nodes of a package. `places` come in the machine's order.
std::vector<int> cores_first(const std::vector<unit_place>& places);

/// Which processing unit each thread of a measurement runs on, of those this process was given (taskset, containers).
/// Made once per process, before any thread is bound. A thread that cannot be bound runs wherever it may: description()
/// says so.
class thread_binding {
 public:
  /// `word`: "cores_first", or "none" to bind nothing; any other is a pairsum::error.
  explicit thread_binding(std::string_view word = "cores_first");
  ~thread_binding();

  /// The calling thread on unit k, k counting from 0 and again when there are more threads than units. False if it is
  /// not bound.
  bool bind_this_thread(int k) const;
  /// The calling thread on any unit of the process again.
  void release_this_thread() const;

  /// The unit of thread 0, 1, ...; empty if nothing is bound.
  const std::vector<int>& units() const;
  /// "cores_first 0,1", "none", or "none: " and why, or who binds instead.
  std::string description() const;

 private:
  struct state;
  std::unique_ptr<state> state_;
};

}  // namespace pairsum::harness
