#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sum/reference.hpp"
#include "sum/summation.hpp"

namespace pairsum {

/// One way to sum that was built: a backend with an interaction, a smoothing kernel, a dimension and a precision.
struct combination {
  std::string interaction, smoothing;  ///< smoothing is "" where the interaction uses none
  int dim;
  std::string precision;
  bool operator==(const combination&) const = default;
};

/// The same as words that live for ever.
struct combination_words {
  std::string_view interaction, smoothing;
  int dim;
  std::string_view precision;
  operator combination() const {
    return {std::string(interaction), std::string(smoothing), dim, std::string(precision)};
  }
};

/// A backend as `pairsum list` shows it.
struct backend_entry {
  backend_traits traits;
  std::string unavailable;  ///< why it cannot be used, empty if it can
};

/// A word that is known but was left out of this build.
struct missing_word {
  std::string kind, word;  ///< kind: dimension, precision, interaction, smoothing kernel
  std::string option;      ///< the CMake option that brings it
};

/// All that was built, and the only door to it.
class registry {
 public:
  /// The registry of this library, filled by the enrolment that the build generates.
  static const registry& instance();

  const std::vector<backend_entry>& backends() const { return backends_; }
  std::vector<std::string> interactions() const;
  std::vector<std::string> smoothings() const;
  std::vector<std::string> precisions() const;
  std::vector<int> dims() const;
  /// Every interaction, smoothing kernel, dimension and precision that there is a reference for. Not each with each: a
  /// build may have chosen (PAIRSUM_FORMULAS), and `count` has no precision mixed.
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

  /// The summation that `s` names, without particles yet. Errors: unknown names, combinations that were not built, M,
  /// H, Omega.
  std::unique_ptr<summation> make_summation(const setup& s) const;
  /// The oracle for the interaction, smoothing, dimension and precision that `s` names.
  std::unique_ptr<reference> make_reference(const setup& s) const;

  // For the enrolment.
  using summation_maker = std::unique_ptr<summation> (*)(const setup&);
  /// Puts a summation around another; the setup's backend is the wrapper's own name.
  using summation_wrapper = std::unique_ptr<summation> (*)(std::unique_ptr<summation>, const setup&);
  using reference_maker = std::unique_ptr<reference> (*)(const setup&);
  void enrol_backend(const backend_traits& t, std::string unavailable = {});
  void enrol_missing(missing_word m);
  void enrol(std::string_view backend, const combination_words& c, summation_maker make);
  /// Enrols a backend that wraps `base`, an enrolled one, for every combination that `base` has. Throws pairsum::error
  /// if there is no such base, if it is itself a wrapper, or if t.name is enrolled.
  void enrol_wrapper(const backend_traits& t, const std::string& base, summation_wrapper wrap);
  void enrol_reference(const combination_words& c, reference_maker make);

 private:
  template <class Words>
  void check_built(const std::string& kind, const std::string& word, const Words& built) const;
  template <class Entries>
  const auto& find(const Entries& entries, const setup& s) const;

  struct made {
    std::string backend;
    combination what;
    summation_maker make;
    summation_wrapper wrap = nullptr;
    std::string base = {};  ///< the wrapped backend
  };
  struct oracle {
    combination what;
    reference_maker make;
  };
  std::vector<backend_entry> backends_;
  std::vector<missing_word> missing_;
  std::vector<made> summations_;
  std::vector<oracle> references_;
};

}  // namespace pairsum
