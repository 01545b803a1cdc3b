#pragma once
#include <string>
#include <vector>

#include <pairsum/sum/formula.hpp>
#include <pairsum/sum/schedule.hpp>
#include <pairsum/sum/summation.hpp>

namespace pairsum {

/// A formula as words: an interaction, a smoothing kernel, a dimension and a precision.
struct combination {
  std::string interaction, smoothing;  ///< smoothing is "" where the interaction uses none
  int dim;
  std::string precision;
  bool operator==(const combination&) const = default;
};

/// A word that is known but was left out of this build.
struct missing_word {
  std::string kind, word;  ///< kind: dimension, precision, interaction, smoothing kernel
  std::string option;      ///< the CMake option that brings it
};

/// Puts a summation around another; the setup's backend is the wrapper's own name.
using summation_wrapper = std::unique_ptr<summation> (*)(std::unique_ptr<summation>, const setup&);

/// All backends and formulas, in every combination: the only access to both.
class registry {
 public:
  /// The registry of this library.
  static const registry& instance();
  /// The same, for a program that adds plug-ins to it: at its start, before anything reads it.
  static registry& changeable_instance();

  const std::vector<backend_entry>& backends() const { return backends_; }
  std::vector<std::string> interactions() const;
  std::vector<std::string> smoothings() const;
  std::vector<std::string> precisions() const;
  std::vector<int> dims() const;
  /// Not each interaction with each smoothing kernel, dimension and precision: `count` has no precision mixed.
  std::vector<combination> formulas() const;

  const std::vector<missing_word>& missing() const { return missing_; }

  // Throw pairsum::error for a word that is not built: an unknown one with those that are, one that was left out with
  // the option that brings it.
  void check_interaction(const std::string& word) const;
  void check_smoothing(const std::string& word) const;
  void check_precision(const std::string& word) const;
  void check_dim(int dim) const;
  /// Does the interaction take a smoothing kernel? One that is not built does not.
  bool is_smoothed(const std::string& interaction) const;

  /// The backend's entry; an unknown or unavailable name is an error that lists the valid ones.
  const backend_entry& find_backend(const std::string& name) const;

  /// The summation that `s` names, without particles yet. Errors: unknown names, formulas that were not built, M, H,
  /// Omega, instruction sets.
  std::unique_ptr<summation> make_summation(const setup& s) const;
  /// The oracle for the interaction, smoothing, dimension and precision that `s` names.
  std::unique_ptr<reference> make_reference(const setup& s) const;

  /// Throw pairsum::error if there is such a backend, or such a formula, already.
  void add(backend_entry b);
  void add(formula_entry f);
  void add_missing(missing_word m);
  /// Adds a backend that wraps `base`. Throws pairsum::error if there is no such base, if it is itself a wrapper, or if
  /// t.name is taken.
  void add_wrapper(const backend_traits& t, const std::string& base, summation_wrapper wrap);

 private:
  template <class Words>
  void check_built(const std::string& kind, const std::string& word, const Words& built) const;
  const formula_entry& find_formula(const setup& s) const;

  struct wrapper {
    std::string name, base;
    summation_wrapper wrap;
  };
  std::vector<backend_entry> backends_;
  std::vector<formula_entry> formulas_;
  std::vector<wrapper> wrappers_;
  std::vector<missing_word> missing_;
};

/// Adds all that this build of the library holds (kernels/library.cpp).
void add_library(registry& r);

}  // namespace pairsum
