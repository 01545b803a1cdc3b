#pragma once
#include <cstddef>

namespace pairsum {

/// Notified when the passes of a parallel sum, and each thread's work in them, begin and end, so that a caller can
/// measure how long threads work and how long they wait at the barrier after a pass. The library has no clock; the
/// observer has one. Calls of one thread come in order; those of different threads come at the same time.
class pass_observer {
 public:
  virtual ~pass_observer() = default;
  virtual void pass_begins(unsigned pass) = 0;              ///< by the caller's thread
  virtual void work_begins(unsigned pass, int thread) = 0;  ///< by thread `thread` of the team; maybe several times
  virtual void work_ends(unsigned pass, int thread) = 0;    ///< before the thread waits for the others
  virtual void pass_ends(unsigned pass) = 0;                ///< by the caller's thread, when all are done
  /// Does it want to know of every unit of work? Asked once per sum.
  virtual bool wants_units() const { return false; }
  /// Unit k of a pass (what one thread does without synchronisation) begins.
  virtual void unit_begins(unsigned /*pass*/, std::size_t /*k*/) {}
};

/// Passes marks to an observer, if there is one.
class pass_marks {
 public:
  pass_marks() = default;
  explicit pass_marks(pass_observer* observer)
      : observer_(observer), units_(observer != nullptr && observer->wants_units() ? observer : nullptr) {}

  void pass_begins(unsigned pass) const {
    if (observer_ != nullptr) observer_->pass_begins(pass);
  }
  void work_begins(unsigned pass, int thread) const {
    if (observer_ != nullptr) observer_->work_begins(pass, thread);
  }
  void work_ends(unsigned pass, int thread) const {
    if (observer_ != nullptr) observer_->work_ends(pass, thread);
  }
  void pass_ends(unsigned pass) const {
    if (observer_ != nullptr) observer_->pass_ends(pass);
  }
  void unit_begins(unsigned pass, std::size_t k) const {
    if (units_ != nullptr) [[unlikely]]
      units_->unit_begins(pass, k);
  }

 private:
  pass_observer *observer_ = nullptr, *units_ = nullptr;
};

}  // namespace pairsum
