#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pairsum/files/hdf5_dialects.hpp>
#include <pairsum/files/hdf5_file.hpp>
#include <pairsum/files/particle_file.hpp>

namespace pairsum::files {

/// A column of a dataset, and which axis it is of.
struct source {
  std::string dataset;
  std::size_t column = 0, axis = 0;
};
using sources = std::vector<source>;

/// A group with particles, and where its columns are. Empty: not there.
struct particle_group {
  const hdf5_file* file = nullptr;
  std::string path, label;  ///< "particles/fluid/arrays", "fluid"
  sources x, v, rho, m, h, kind, other;
  std::size_t rows = 0;
  bool boundary = false;

  int number() const {
    const std::size_t digits = label.find_last_not_of("0123456789") + 1;
    return digits < label.size() && label.size() - digits < 9 ? std::stoi(label.substr(digits)) : -1;
  }
};

/// The numbers of the first of these attributes that is there, of texts that are numbers, too.
std::optional<std::vector<double>> attribute_of(const hdf5_file& file, const std::string& group,
                                                std::string_view alternatives);

/// The groups of a file that match a pattern with at most one *. Nothing is located in them.
std::vector<particle_group> matching(const hdf5_file& file, std::string_view pattern);

/// The groups of a file that are meant, with their columns located and their kinds chosen by option or name. Says in
/// `content` which groups there are, and what it leaves out.
std::vector<particle_group> groups_of(const hdf5_file& file, const hdf5_dialect& names, const hints& told,
                                      file_content& content);

}  // namespace pairsum::files
