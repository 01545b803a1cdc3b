#pragma once
#include <cstddef>

namespace pairsum {

/// Told when the passes of a parallel sum, and each thread's work in them, begin and end: what a caller needs to see
/// how long threads work and how long they wait at the barrier after a pass. The library has no clock; the observer
/// has. Calls of one thread come in order; those of different threads come at the same time.
class pass_observer {
 public:
  virtual ~pass_observer() = default;
  virtual void pass_begins(unsigned pass) = 0;              ///< by the caller's thread
  virtual void work_begins(unsigned pass, int thread) = 0;  ///< by thread `thread` of the team; maybe several times
  virtual void work_ends(unsigned pass, int thread) = 0;    ///< before the thread waits for the others
  virtual void pass_ends(unsigned pass) = 0;                ///< by the caller's thread, when all are done
};

/// Hands marks to an observer, if there is one; a part of the probes that backends are given.
struct pass_marks {
  pass_observer* observer = nullptr;

  void pass_begins(unsigned pass) const {
    if (observer != nullptr) observer->pass_begins(pass);
  }
  void work_begins(unsigned pass, int thread) const {
    if (observer != nullptr) observer->work_begins(pass, thread);
  }
  void work_ends(unsigned pass, int thread) const {
    if (observer != nullptr) observer->work_ends(pass, thread);
  }
  void pass_ends(unsigned pass) const {
    if (observer != nullptr) observer->pass_ends(pass);
  }
};

/// Tells marks that want to know that unit k of a pass, what one thread does without asking others, begins.
template <class Marks>
[[gnu::always_inline]] inline void mark_unit(Marks& marks, unsigned pass, std::size_t k) {
  if constexpr (requires { marks.unit_begins(pass, k); }) marks.unit_begins(pass, k);
}

}  // namespace pairsum
