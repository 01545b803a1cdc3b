#pragma once
#include <string_view>

namespace pairsum {

/// How a backend keeps two threads from writing to one particle at a time.
enum class conflict_avoidance {
  serial,   ///< one thread
  gather,   ///< a thread writes only its own particles; pairs between threads are computed twice
  colours,  ///< units that run together share no particle; barriers between colours
  atomics,  ///< every addition is atomic
  copies,   ///< threads or passes add to private copies of the rates, which are reduced
  locks,    ///< particles or cells are locked while they are added to
  tasks,    ///< conflicting tasks wait for each other
};

inline constexpr std::string_view name_of(conflict_avoidance c) {
  constexpr std::string_view names[]{"serial", "gather", "colours", "atomics", "copies", "locks", "tasks"};
  return names[static_cast<unsigned>(c)];
}

/// The same in a phrase for people.
inline constexpr std::string_view meaning_of(conflict_avoidance c) {
  constexpr std::string_view phrases[]{"one thread",
                                       "a thread writes its own particles alone; pairs with others' are computed twice",
                                       "what runs at a time shares no particle; barriers between colours",
                                       "every addition is atomic",
                                       "threads or passes add to copies of the rates, which are joined",
                                       "particles or cells are locked while they are added to",
                                       "tasks that would share particles wait for each other"};
  return phrases[static_cast<unsigned>(c)];
}

}  // namespace pairsum
